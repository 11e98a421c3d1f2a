//! Requests to the workbench that nobody should send.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::bench::Share;
use super::fate::Fate;
use crate::workbench::Workbench;

impl Workbench {
    fn start() -> Self {
        let child = Command::new(env!("CARGO_BIN_EXE_hexbench"))
            .arg("workbench")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        Self::of(child)
    }

    /// Sends bytes, with the address and the token in place of `HOST` and `TOKEN`; the answer, or nothing where the line is closed.
    fn answer(&self, request: &str) -> String {
        let request = request.replace("HOST", &self.address).replace("TOKEN", &self.token);
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        // A server that has said no need not read on.
        let _ = stream.write_all(request.as_bytes());
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn fate(&self, request: &str, codes: &[&str]) -> Fate {
        let answer = self.answer(request);
        let code = answer.get(9..12).unwrap_or("closed");
        let is_alive = self.answer(SOUND).starts_with("HTTP/1.1 200");
        if is_alive && codes.contains(&code) {
            Fate::Refused
        } else {
            Fate::Broken(format!("{request:.80}: {code}, alive {is_alive}"))
        }
    }
}

const SOUND: &str =
    "GET /api/catalogue HTTP/1.1\r\nHost: HOST\r\nAuthorization: Bearer TOKEN\r\nConnection: close\r\n\r\n";

/// Heads that are refused, and bodies.
pub(super) fn requests(share: Share) -> Vec<Fate> {
    let bench = Workbench::start();
    let to = |path: &str, more: &str, body: &str| {
        format!(
            "POST {path} HTTP/1.1\r\nHost: HOST\r\nAuthorization: Bearer TOKEN\r\nConnection: close\r\n\
             Content-Type: application/json\r\n{more}Content-Length: {}\r\n\r\n{body}",
            body.len()
        )
    };
    let open = |body: &str| to("/api/benches", "", body);
    let get = |host: &str, more: &str| {
        format!("GET /api/catalogue HTTP/1.1\r\nHost: {host}\r\n{more}Connection: close\r\n\r\n")
    };
    let token = "Authorization: Bearer TOKEN\r\n";
    let cases: Vec<(String, &[&str])> = vec![
        (get("example.com", token), &["403"]),
        (get("HOST.", token), &["403"]),
        (get("127.0.0.1", token), &["403"]),
        (get("HOST", ""), &["401"]),
        (get("HOST", "Authorization: Bearer 0\r\n"), &["401"]),
        (get("HOST", &format!("{token}Origin: http://example.com\r\n")), &["403"]),
        (get("HOST", &format!("{token}Origin: null\r\n")), &["403"]),
        ("GET /../../etc/passwd HTTP/1.1\r\nHost: HOST\r\nConnection: close\r\n\r\n".into(), &["404"]),
        (
            "GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\nHost: HOST\r\nConnection: close\r\n\r\n".into(),
            &["404"],
        ),
        ("\u{16}\u{3}\u{1} no HTTP at all\r\n\r\n".into(), &["400", "closed"]),
        (open(""), &["400"]),
        (open("{"), &["400"]),
        (open(&"[".repeat(1 << 20)), &["400"]),
        (open(r#"{"from":"given"}"#), &["404", "409", "422"]),
        (open(r#"{"from":"case","id":"../../etc/passwd"}"#), &["404"]),
        (to("/api/benches/none/view", "", r#"{"terms":[]}"#), &["404"]),
        (to("/api/benches", "Content-Length: 3\r\n", "{}"), &["400"]),
        (to("/api/benches", "Transfer-Encoding: xchunked\r\n", "{}"), &["400"]),
        (open(&" ".repeat(34 << 20)), &["413", "closed"]),
    ];
    share.each(&cases, |(request, codes)| bench.fate(request, codes))
}
