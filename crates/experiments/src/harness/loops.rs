//! The one loop over work.

use rayon::prelude::*;

use super::Progress;
use crate::error::ExperimentError;

/// Does work on all threads; what it gives comes in the order of the work. Ends early at an error or when told to.
pub(crate) fn each<W: Send, T: Send, E: From<ExperimentError> + Send>(
    work: impl IntoParallelIterator<Item = W>,
    progress: &dyn Progress,
    one: impl Fn(W) -> Result<T, E> + Sync + Send,
) -> Result<Vec<T>, E> {
    let unless_stopped = |work| {
        if progress.is_stopped() { Err(ExperimentError::Stopped.into()) } else { one(work) }
    };
    work.into_par_iter().map(unless_stopped).collect()
}

/// Works on so many threads; on those there are when they cannot be had.
pub(crate) fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}
