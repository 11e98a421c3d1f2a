//! Computations: a few at once, others wait for a limited time, and a panic becomes an answer.

use std::sync::Arc;
use std::time::Duration;

use axum::http::StatusCode;
use hexbench_core::interrupt::Interrupt;
use rayon::{ThreadPoolBuilder, current_num_threads};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::spawn_blocking;
use tokio::time::timeout;

use super::refuse::Refuse;
use super::{STACK_BYTES, ServerSettings};

/// Places for computations and for those that wait.
#[derive(Debug)]
pub(super) struct Work {
    admitted: Arc<Semaphore>,
    computing: Arc<Semaphore>,
    wait: Duration,
    compute: Duration,
}

/// A place, until it is dropped.
#[derive(Debug)]
pub(super) struct Place(#[expect(dead_code, reason = "held, never read")] OwnedSemaphorePermit);

/// Ends a computation when nobody waits for it any more: its client has gone away, or its time is over.
struct AskOnDrop(Interrupt);

impl Drop for AskOnDrop {
    fn drop(&mut self) {
        self.0.ask();
    }
}

/// Every computation has as many threads as there are cores: they know whom to obey.
fn on_own_threads<T: Send>(interrupt: &Interrupt, job: impl FnOnce() -> T + Send) -> T {
    let obeyed = interrupt.clone();
    let threads = ThreadPoolBuilder::new()
        .num_threads(current_num_threads())
        .stack_size(STACK_BYTES)
        .start_handler(move |_| obeyed.obeyed_here())
        .build();
    // A system without threads to spare computes on those there are, to the end.
    match threads {
        Ok(threads) => threads.install(job),
        Err(_) => job(),
    }
}

impl Work {
    /// As many places as the settings say.
    pub(super) fn of(settings: &ServerSettings) -> Self {
        Self {
            admitted: Arc::new(Semaphore::new(settings.computing + settings.waiting)),
            computing: Arc::new(Semaphore::new(settings.computing)),
            wait: settings.wait,
            compute: settings.compute,
        }
    }

    /// A place to compute or to wait for it.
    pub(super) fn admit(&self) -> Result<Place, Refuse> {
        let permit = Arc::clone(&self.admitted).try_acquire_owned();
        permit.map(Place).map_err(|_| Refuse::busy("too many requests are waiting already"))
    }

    /// Compute on threads of its own. Who stops waiting frees a place in the queue at once, and a computation that nobody waits for any
    /// more ends at its next step.
    pub(super) async fn run<T: Send + 'static>(
        &self,
        place: Place,
        job: impl FnOnce() -> Result<T, Refuse> + Send + 'static,
    ) -> Result<T, Refuse> {
        let turn = timeout(self.wait, Arc::clone(&self.computing).acquire_owned()).await;
        let Ok(Ok(permit)) = turn else { return Err(Refuse::busy("other computations took too long")) };
        let interrupt = Interrupt::default();
        let _unwanted = AskOnDrop(interrupt.clone());
        let running = spawn_blocking(move || {
            let _held = (place, permit);
            on_own_threads(&interrupt, job)
        });
        match timeout(self.compute, running).await {
            Ok(Ok(result)) => result,
            Ok(Err(_panicked)) => Err(Refuse::fault()),
            Err(_) => Err(self.too_slow()),
        }
    }

    fn too_slow(&self) -> Refuse {
        let error = format!("stopped after {} s without a result", self.compute.as_secs_f64());
        let next = "Use fewer readings or fewer terms of your own, or the command line, which has no limit.";
        Refuse::new(StatusCode::SERVICE_UNAVAILABLE, error, next)
    }
}
