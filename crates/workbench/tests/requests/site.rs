//! A server with short limits, and a client that sends exactly what it is given.

use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

use hexbench_workbench::server::{Server, ServerSettings};
use hexbench_workbench::wire::ServerLimits;

use crate::engine::Obedient;

/// Time limits of the server under test.
pub(crate) const SHORT: Duration = Duration::from_millis(300);
/// No connection without new requests stays longer.
pub(crate) const PATIENCE: Duration = Duration::from_secs(10);
/// Bytes of a request the server under test takes.
pub(crate) const BYTES: usize = 64 << 10;

/// Benches, computations and waiting requests at once.
pub(crate) const PLACES: (usize, usize, usize) = (2, 1, 1);

/// A running server.
pub(crate) struct Site {
    pub(crate) port: u16,
    pub(crate) token: String,
}

/// What came back.
#[derive(Debug, Clone, Default)]
pub(crate) struct Reply {
    /// Status, `closed` without an answer, or a summary of many.
    pub(crate) answer: String,
    /// Header lines.
    pub(crate) head: Vec<String>,
    /// Body.
    pub(crate) body: Vec<u8>,
}

impl Reply {
    pub(crate) fn summary(answer: impl Into<String>) -> Self {
        Self { answer: answer.into(), ..Self::default() }
    }

    fn of(bytes: &[u8]) -> Self {
        let Some(end) = bytes.windows(4).position(|four| four == b"\r\n\r\n") else {
            return Self::summary("closed");
        };
        let head = String::from_utf8(bytes[..end].to_vec()).expect("heads are text");
        let mut lines = head.split("\r\n").map(str::to_owned);
        let answer =
            lines.next().and_then(|line| line.split(' ').nth(1).map(str::to_owned)).expect("a status");
        Self { answer, head: lines.collect(), body: bytes[end + 4..].to_vec() }
    }

    /// Value of a header.
    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        self.head.iter().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "))
    }

    /// A text of the JSON body.
    pub(crate) fn text(&self, key: &str) -> Option<String> {
        let body: serde_json::Value = serde_json::from_slice(&self.body).ok()?;
        Some(body.get(key)?.as_str()?.to_owned())
    }
}

impl Site {
    /// A server that runs as long as the test.
    pub(crate) fn start() -> Self {
        let (benches, computing, waiting) = PLACES;
        let limits = ServerLimits { bytes: BYTES, rows: 100, own_terms: 8, term_bytes: 1000, benches };
        let settings = ServerSettings {
            limits,
            computing,
            waiting,
            connections: 64,
            head: SHORT,
            body: SHORT,
            write: SHORT,
            linger: 10 * SHORT,
            wait: 3 * SHORT,
            compute: 4 * SHORT,
            ..ServerSettings::default()
        };
        let server = Server::bind_with::<Obedient>(&settings, None).expect("a free port");
        let (port, token) = (server.port(), server.token().to_owned());
        thread::spawn(|| server.run_until(std::future::pending()));
        Self { port, token }
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).expect("the server listens");
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream.set_write_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// Send bytes, read until the server closes.
    pub(crate) fn exchange(&self, bytes: &[u8]) -> Reply {
        let mut stream = self.connect();
        // A server that has said no may stop listening.
        let _ = stream.write_all(bytes);
        answer(&mut stream)
    }

    /// Send a request, read the answer.
    pub(crate) fn send(&self, ask: &Ask) -> Reply {
        self.exchange(&self.bytes(ask))
    }

    /// Send a request again and again as long as the server is busy.
    pub(crate) fn patiently(&self, ask: &Ask) -> Reply {
        let begin = Instant::now();
        loop {
            let reply = self.send(ask);
            if reply.answer != "503" || begin.elapsed() > PATIENCE {
                return reply;
            }
            sleep(SHORT / 10);
        }
    }

    /// A request with this server's port and token in it.
    pub(crate) fn bytes(&self, ask: &Ask) -> Vec<u8> {
        let head = ask.head.join("\r\n") + "\r\n\r\n";
        let head = head.replace("{port}", &self.port.to_string()).replace("{token}", &self.token);
        [head.as_bytes(), &ask.body].concat()
    }

    /// Open a bench; its id.
    pub(crate) fn open(&self) -> String {
        let reply = self.patiently(&post("/api/benches", r#"{"from":"given"}"#));
        assert_eq!(reply.answer, "201", "{reply:?}");
        reply.text("id").expect("an id")
    }
}

/// All that comes until the server closes.
pub(crate) fn answer(stream: &mut TcpStream) -> Reply {
    let mut bytes = vec![];
    match stream.read_to_end(&mut bytes) {
        Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
            Reply::summary("still open")
        }
        // A reset at the end takes nothing from what was read before.
        _ => Reply::of(&bytes),
    }
}

/// A request line by line; `{port}` and `{token}` are filled in when it is sent.
#[derive(Debug, Clone)]
pub(crate) struct Ask {
    head: Vec<String>,
    body: Vec<u8>,
}

/// A request of the page.
pub(crate) fn ask(method: &str, path: &str) -> Ask {
    let head = [
        &format!("{method} {path} HTTP/1.1"),
        "Host: 127.0.0.1:{port}",
        "Connection: close",
        "Authorization: Bearer {token}",
    ];
    Ask { head: head.map(str::to_owned).to_vec(), body: vec![] }
}

pub(crate) fn get(path: &str) -> Ask {
    ask("GET", path)
}

/// JSON sent by the page.
pub(crate) fn post(path: &str, body: impl Into<Vec<u8>>) -> Ask {
    ask("POST", path).with("Content-Type: application/json").body(body)
}

impl Ask {
    /// Without a header.
    pub(crate) fn without(mut self, name: &str) -> Self {
        self.head.retain(|line| !line.starts_with(&format!("{name}:")));
        self
    }

    /// With one more header.
    pub(crate) fn with(mut self, line: impl Into<String>) -> Self {
        self.head.push(line.into());
        self
    }

    /// With another value of a header.
    pub(crate) fn but(self, line: &str) -> Self {
        let name = line.split(':').next().expect("a header");
        self.without(name).with(line)
    }

    /// In an older version.
    pub(crate) fn old(mut self) -> Self {
        self.head[0] = self.head[0].replace("HTTP/1.1", "HTTP/1.0");
        self
    }

    /// With a body and its length.
    pub(crate) fn body(self, body: impl Into<Vec<u8>>) -> Self {
        let body = body.into();
        Self { body: body.clone(), ..self.but(&format!("Content-Length: {}", body.len())) }
    }

    /// In chunks, which say nothing of the whole length.
    pub(crate) fn chunked(self, body: &[u8]) -> Self {
        let mut chunks = vec![];
        for part in body.chunks(4096) {
            chunks
                .extend(format!("{:x}\r\n", part.len()).bytes().chain(part.iter().copied()).chain(*b"\r\n"));
        }
        chunks.extend(b"0\r\n\r\n");
        Self { body: chunks, ..self.without("Content-Length").with("Transfer-Encoding: chunked") }
    }
}
