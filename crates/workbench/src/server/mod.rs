//! The local server of the workbench: it serves the embedded page, and answers of the engine as JSON.
//!
//! It listens on the loopback address only and answers no request without the token it made at its start. A request passes, in this
//! order: the limit on connections, time limits on its head, `Host` and `Origin` (`guard`), the token, path and method (`api`),
//! content type and size (`body`), the limit on simultaneous computations (`work`), the shape of its JSON, and finally the
//! engine ([`Desk`]). Each refusal is a [`Refused`](crate::wire::Refused) with a next step. The server neither reads nor writes
//! files.

mod api;
mod assets;
mod body;
mod connection;
mod desk;
mod guard;
mod headers;
mod refuse;
mod settings;
mod store;
mod token;
mod work;

pub use desk::Desk;
pub use settings::ServerSettings;

use std::future::{Future, poll_fn};
use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::task::Poll;

use axum::Router;
use tokio::net::{TcpListener, TcpSocket};
use tokio::runtime::{Builder, Runtime};

use crate::bench::{Given, LoadedCampaign};
use api::Shared;
use connection::Connections;
use token::Token;

/// Stack of a thread that computes, bytes: that of a main thread.
const STACK_BYTES: usize = 8 << 20;
/// Connections the system keeps until they are accepted.
const BACKLOG: u32 = 1024;

/// A server that listens and does not answer yet.
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    port: u16,
    token: String,
    app: Router,
    connections: Connections,
}

impl Server {
    /// Listen, with files of the command line for the page when there are any.
    ///
    /// # Errors
    /// When the port is taken or the system gives no threads or no random bytes.
    pub fn bind(settings: &ServerSettings, given: Option<Given>) -> io::Result<Self> {
        Self::bind_with::<LoadedCampaign>(settings, given)
    }

    /// Listen, with another engine.
    ///
    /// # Errors
    /// As [`Server::bind`].
    pub fn bind_with<D: Desk>(settings: &ServerSettings, given: Option<Given>) -> io::Result<Self> {
        let runtime = Builder::new_multi_thread().enable_all().thread_stack_size(STACK_BYTES).build()?;
        let listener = {
            let _entered = runtime.enter();
            listen(settings.port)?
        };
        let port = listener.local_addr()?.port();
        let token = Token::random()?;
        let shared = Arc::new(Shared::<D>::new(settings, given)?);
        let app = api::app(shared, guard::Names::of(port), token.clone());
        Ok(Self { runtime, listener, port, token: token.text(), app, connections: Connections::of(settings) })
    }

    /// Port on the loopback address.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// What goes into `Authorization: Bearer`.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// The address to open; the token is in the fragment, which a browser keeps to itself.
    pub fn url(&self) -> String {
        format!("http://{}:{}/#token={}", Ipv4Addr::LOCALHOST, self.port, self.token)
    }

    /// Ends when the program is asked to: Ctrl-C, on Unix the signal TERM too. From here on neither ends the program by itself.
    ///
    /// # Errors
    /// When the system lets nobody listen to signals.
    pub fn asked_to_stop(&self) -> io::Result<impl Future<Output = ()> + use<>> {
        let _entered = self.runtime.enter();
        signals()
    }

    /// Answer until then. Computations that still run are abandoned.
    pub fn run_until(self, stop: impl Future<Output = ()>) {
        self.runtime.spawn(self.connections.accept(self.listener, self.app));
        self.runtime.block_on(stop);
        self.runtime.shutdown_background();
    }
}

fn listen(port: u16) -> io::Result<TcpListener> {
    let socket = TcpSocket::new_v4()?;
    #[cfg(unix)]
    socket.set_reuseaddr(true)?;
    socket.bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)))?;
    socket.listen(BACKLOG)
}

#[cfg(unix)]
fn signals() -> io::Result<impl Future<Output = ()> + use<>> {
    use tokio::signal::unix::{SignalKind, signal};
    let (mut interrupt, mut terminate) = (signal(SignalKind::interrupt())?, signal(SignalKind::terminate())?);
    Ok(poll_fn(move |cx| match (interrupt.poll_recv(cx), terminate.poll_recv(cx)) {
        (Poll::Pending, Poll::Pending) => Poll::Pending,
        _ => Poll::Ready(()),
    }))
}

#[cfg(windows)]
fn signals() -> io::Result<impl Future<Output = ()> + use<>> {
    let mut ctrl_c = tokio::signal::windows::ctrl_c()?;
    Ok(poll_fn(move |cx| ctrl_c.poll_recv(cx).map(|_| ())))
}
