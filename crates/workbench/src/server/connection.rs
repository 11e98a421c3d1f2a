//! Connections: a cap on their number, time limits, and an end at which the client still gets its answer.

use std::convert::Infallible;
use std::future::poll_fn;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::http::header::CONNECTION;
use axum::http::{HeaderValue, Request};
use axum::response::{IntoResponse, Response};
use hyper::body::Incoming;
use hyper::server::conn::http1::Builder;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{sleep, timeout};
use tokio_io_timeout::TimeoutStream;

use super::refuse::Refuse;
use super::{ServerSettings, headers};

/// Bytes of the head of a request.
const HEAD_BYTES: usize = 32 << 10;
/// After an accept that failed, as when the system has no more descriptors.
const PAUSE: Duration = Duration::from_millis(50);

/// How connections are treated.
#[derive(Debug, Clone)]
pub(super) struct Connections {
    answered: Arc<Semaphore>,
    turned_away: Arc<Semaphore>,
    head: Duration,
    write: Duration,
    linger: Duration,
}

impl Connections {
    /// As many as the settings say.
    pub(super) fn of(settings: &ServerSettings) -> Self {
        Self {
            answered: Arc::new(Semaphore::new(settings.connections)),
            turned_away: Arc::new(Semaphore::new(settings.turned_away)),
            head: settings.head,
            write: settings.write,
            linger: settings.linger,
        }
    }

    /// Accept and answer, for ever.
    pub(super) async fn accept(self, listener: TcpListener, app: Router) {
        let app = TowerToHyperService::new(app);
        let full = || service_fn(|_| Box::pin(async { Ok(turned_away().await) }));
        loop {
            let Ok((stream, _)) = listener.accept().await else {
                sleep(PAUSE).await;
                continue;
            };
            if let Ok(place) = Arc::clone(&self.answered).try_acquire_owned() {
                let app = app.clone();
                let app = service_fn(move |request| Box::pin(app.call(request)));
                tokio::spawn(self.clone().serve(stream, app, self.head, place));
            } else if let Ok(place) = Arc::clone(&self.turned_away).try_acquire_owned() {
                tokio::spawn(self.clone().serve(stream, full(), self.linger, place));
            }
        }
    }

    /// Answer one connection; `head` limits the wait for each request.
    async fn serve<S>(self, stream: TcpStream, service: S, head: Duration, place: OwnedSemaphorePermit)
    where
        S: Service<Request<Incoming>, Response = Response, Error = Infallible, Future: Unpin> + Unpin,
    {
        let _held = place;
        let mut stream = TimeoutStream::new(stream);
        stream.set_write_timeout(Some(self.write));
        let io = TokioIo::new(Box::pin(stream));
        let mut connection = Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(head)
            .max_header_size(HEAD_BYTES)
            .serve_connection(io, service);
        // Whatever ended it, a client or a limit, there is nobody to tell.
        let _ended = poll_fn(|cx| connection.poll_without_shutdown(cx)).await;
        let stream = connection.into_parts().io.into_inner();
        let _closed = timeout(self.linger, close(stream)).await;
    }
}

/// The answer of a server with too many connections.
async fn turned_away() -> Response {
    let refuse = Refuse::busy("too many connections are open");
    let mut response = headers::add(refuse.into_response()).await;
    response.headers_mut().insert(CONNECTION, HeaderValue::from_static("close"));
    response
}

/// Says that no more comes, then reads what still does: closing on unread bytes would take the answer from the client.
async fn close(mut stream: impl AsyncRead + AsyncWrite + Unpin) -> io::Result<()> {
    stream.shutdown().await?;
    let mut unread = [0; 8192];
    while stream.read(&mut unread).await? > 0 {}
    Ok(())
}
