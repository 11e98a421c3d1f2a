//! Computing beside Python: its threads go on, Ctrl-C is heard, a panic is an exception, an exception of a function called is itself.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;

use hexbench_app::Failure;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{internal, raised};

/// How often Python is asked whether Ctrl-C was pressed.
const PATIENCE: Duration = Duration::from_millis(50);

/// The threads of a process. A process forked from another has none of its threads, and makes its own.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

fn pool(py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut made = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, pool)) = made.as_ref().filter(|(owner, _)| *owner == process::id()) {
        return Ok(Arc::clone(pool));
    }
    let threads = ThreadPoolBuilder::new().thread_name(|n| format!("hexbench-{n}")).build();
    let pool = Arc::new(threads.map_err(|cause| internal(py, &cause.to_string()))?);
    // The pool of another process is let go without a word to its threads, which are not here.
    std::mem::forget(made.replace((process::id(), Arc::clone(&pool))));
    Ok(pool)
}

/// Number of threads that compute.
pub(crate) fn threads(py: Python<'_>) -> PyResult<usize> {
    Ok(pool(py)?.current_num_threads())
}

/// Computes without holding the interpreter. After Ctrl-C the caller gets `KeyboardInterrupt` at once; the work comes to its end
/// unheard.
pub(crate) fn beside<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    pool(py)?.spawn(move || {
        // Nobody listens after Ctrl-C.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(work)));
    });
    loop {
        let heard;
        (receiver, heard) = py.detach(move || {
            let heard = receiver.recv_timeout(PATIENCE);
            (receiver, heard)
        });
        match heard {
            Ok(Ok(result)) => return result.map_err(|failure| raised(py, &failure)),
            Ok(Err(panic)) => {
                let exception = panic.downcast::<PyErr>();
                return Err(
                    exception.map_or_else(|panic| internal(py, &said(panic.as_ref())), |raised| *raised)
                );
            }
            Err(mpsc::RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(mpsc::RecvTimeoutError::Disconnected) => return Err(internal(py, "no result")),
        }
    }
}

fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a word").to_owned()
}
