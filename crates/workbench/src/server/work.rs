//! Computing: a few at once, others wait for a while, a panic is an answer.

use std::sync::Arc;
use std::time::Duration;

use axum::http::StatusCode;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::spawn_blocking;
use tokio::time::timeout;

use super::ServerSettings;
use super::refuse::Refuse;

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
        permit.map(Place).map_err(|_| Refuse::busy("too many requests wait already"))
    }

    /// Compute on a thread of its own. Who stops waiting frees a place in the queue at once, a running computation frees its
    /// place when it ends.
    pub(super) async fn run<T: Send + 'static>(
        &self,
        place: Place,
        job: impl FnOnce() -> Result<T, Refuse> + Send + 'static,
    ) -> Result<T, Refuse> {
        let turn = timeout(self.wait, Arc::clone(&self.computing).acquire_owned()).await;
        let Ok(Ok(permit)) = turn else { return Err(Refuse::busy("other computations took too long")) };
        let running = spawn_blocking(move || {
            let _held = (place, permit);
            job()
        });
        match timeout(self.compute, running).await {
            Ok(Ok(result)) => result,
            Ok(Err(_panicked)) => Err(Refuse::fault()),
            Err(_) => Err(self.too_slow()),
        }
    }

    fn too_slow(&self) -> Refuse {
        let error = format!(
            "not done after {} s; it cannot be stopped and goes on unheard",
            self.compute.as_secs_f64()
        );
        let next =
            "Ask less: fewer readings, fewer terms of your own; or use the command line, which has no limit.";
        Refuse::new(StatusCode::SERVICE_UNAVAILABLE, error, next)
    }
}
