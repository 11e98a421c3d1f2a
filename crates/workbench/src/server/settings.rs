//! What the server allows.

use std::time::Duration;

use crate::wire::ServerLimits;

/// Limits of time, size and number.
#[derive(Debug, Clone, Copy)]
pub struct ServerSettings {
    /// Port on the loopback address; 0: the system chooses.
    pub port: u16,
    /// What the page is told and the engine keeps to.
    pub limits: ServerLimits,
    /// Bytes of the files behind all benches kept, which take some ten times as much; the bench opened last stays in any case.
    pub kept_bytes: usize,
    /// Connections answered at once.
    pub connections: usize,
    /// Connections beyond that which are told so; any more are closed.
    pub turned_away: usize,
    /// Computations at once.
    pub computing: usize,
    /// Requests that wait for one of them.
    pub waiting: usize,
    /// How long they wait.
    pub wait: Duration,
    /// How long a client waits for its computation.
    pub compute: Duration,
    /// From the end of an answer, or a new connection, to the end of the next request's head.
    pub head: Duration,
    /// From there to the end of its body.
    pub body: Duration,
    /// How long a client may take no byte of an answer.
    pub write: Duration,
    /// How long the rest of a refused request is read and thrown away, so that its client gets to the answer.
    pub linger: Duration,
}

impl Default for ServerSettings {
    fn default() -> Self {
        let limits =
            ServerLimits { bytes: 32 << 20, rows: 50_000, own_terms: 8, term_bytes: 64 << 10, benches: 8 };
        Self {
            port: 0,
            limits,
            kept_bytes: 64 << 20,
            connections: 256,
            turned_away: 512,
            computing: 4,
            waiting: 16,
            wait: Duration::from_secs(30),
            compute: Duration::from_mins(5),
            head: Duration::from_secs(10),
            body: Duration::from_secs(10),
            write: Duration::from_secs(10),
            linger: Duration::from_secs(5),
        }
    }
}
