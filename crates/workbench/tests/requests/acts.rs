//! Requests that take more than one message: slow ones, many at once, ones that give up.

use std::collections::BTreeSet;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

use crate::engine::{LONG, see_none_held, see_one_held, set_gate};
use crate::site::{PLACES, Reply, SHORT, Site, answer, get, post};

/// Connections at once: far more than the server under test has places for.
const CONNECTIONS: usize = 500;
/// Long enough for a request to reach the queue.
const MOMENT: Duration = Duration::from_millis(200);

/// The page, then the same again with its tag.
pub(crate) fn known_page(site: &Site) -> Reply {
    let first = site.send(&get("/"));
    let tag = first.header("etag").expect("assets have tags");
    let again = site.send(&get("/").with(format!("If-None-Match: \"0\", {tag}")));
    assert!(!first.body.is_empty() && again.body.is_empty(), "sent once");
    again
}

/// A head that never ends.
pub(crate) fn half_a_head(site: &Site) -> Reply {
    site.exchange(b"GET / HTTP/1.1\r\nHost: 127")
}

/// A head one byte at a time.
pub(crate) fn slow_head(site: &Site) -> Reply {
    let mut stream = site.connect();
    for byte in b"GET / HTTP/1.1\r\nX-Slow: aaaaaaaaaaaaaaaaaaaaaaaaaaaaa" {
        if stream.write_all(&[*byte]).is_err() {
            break;
        }
        sleep(SHORT / 10);
    }
    answer(&mut stream)
}

/// A connection that asks once and then nothing more.
pub(crate) fn idle(site: &Site) -> Reply {
    site.send(&get("/").without("Connection"))
}

/// A length, and half of what it promises.
pub(crate) fn half_a_body(site: &Site) -> Reply {
    site.send(&post("/api/benches", r#"{"from":"#).but("Content-Length: 16"))
}

/// A large body that is refused for other reasons: all of it can be sent, and then the answer be read.
pub(crate) fn unwanted(site: &Site) -> Reply {
    let mut stream = site.connect();
    let request = post("/api/benches", vec![b' '; 8 << 20]).without("Authorization");
    stream.write_all(&site.bytes(&request)).expect("the server takes what it does not want");
    answer(&mut stream)
}

/// A large answer, and nobody who reads it in time.
pub(crate) fn unread(site: &Site) -> Reply {
    let path = format!("/api/benches/{}/export", site.open());
    let mut stream = site.connect();
    stream.write_all(&site.bytes(&post(&path, r#"{"what":"model"}"#))).unwrap();
    stream.peek(&mut [0]).expect("the answer begins");
    sleep(4 * SHORT);
    let mut bytes = vec![];
    let _ = stream.read_to_end(&mut bytes);
    let whole = bytes.ends_with(b"\"");
    Reply::summary(if whole { "the whole answer" } else { "broken off" })
}

fn let_go() {
    set_gate(true);
    see_none_held();
}

/// A diagnosis that waits at the gate.
fn held(site: &Site) -> TcpStream {
    let path = format!("/api/benches/{}/diagnosis", site.open());
    let mut stream = site.connect();
    stream.write_all(&site.bytes(&post(&path, "{}"))).unwrap();
    see_one_held();
    stream
}

/// One diagnosis runs; its own client waits too long.
pub(crate) fn long_computation(site: &Site) -> Reply {
    set_gate(false);
    let reply = answer(&mut held(site));
    let_go();
    reply
}

/// One diagnosis runs; another request waits for it too long.
pub(crate) fn long_wait(site: &Site) -> Reply {
    set_gate(false);
    let _running = held(site);
    let reply = site.send(&post("/api/benches", r#"{"from":"given"}"#));
    let_go();
    reply
}

/// One diagnosis runs, another waits, a third request is too much.
pub(crate) fn full_queue(site: &Site) -> Reply {
    let path = format!("/api/benches/{}/diagnosis", site.open());
    set_gate(false);
    let _running = held(site);
    let mut waiting = site.connect();
    waiting.write_all(&site.bytes(&post(&path, "{}"))).unwrap();
    sleep(MOMENT);
    let reply = site.send(&post("/api/benches", r#"{"from":"given"}"#));
    let_go();
    reply
}

/// A search that nobody waits for any more ends.
pub(crate) fn gone_while_computing(site: &Site) -> Reply {
    let path = format!("/api/benches/{}/discovery", site.open());
    let mut stream = site.connect();
    stream.write_all(&site.bytes(&post(&path, "{}"))).unwrap();
    see_one_held();
    let since = Instant::now();
    drop(stream);
    see_none_held();
    Reply::summary(if since.elapsed() < LONG / 2 { "stopped" } else { "went on" })
}

/// A search that takes too long ends too.
pub(crate) fn stopped_computation(site: &Site) -> Reply {
    let path = format!("/api/benches/{}/discovery", site.open());
    let since = Instant::now();
    let reply = site.send(&post(&path, "{}"));
    see_none_held();
    assert!(since.elapsed() < LONG / 2, "it went on");
    reply
}

/// Clients that go away while they wait leave their places to others.
pub(crate) fn gone_while_waiting(site: &Site) -> Reply {
    let path = format!("/api/benches/{}/diagnosis", site.open());
    set_gate(false);
    let running = held(site);
    for _ in 0..20 {
        let mut waiting = site.connect();
        waiting.write_all(&site.bytes(&post(&path, "{}"))).unwrap();
        sleep(MOMENT / 20);
    }
    drop(running);
    sleep(MOMENT);
    let_go();
    site.patiently(&post("/api/benches", r#"{"from":"given"}"#))
}

/// All asked, and none closed, before the first answer is read.
pub(crate) fn many_connections(site: &Site) -> Reply {
    let bytes = site.bytes(&get("/api/catalogue"));
    let asked = |_| {
        let mut stream = site.connect();
        stream.write_all(&bytes).unwrap();
        stream
    };
    let mut streams: Vec<TcpStream> = (0..CONNECTIONS).map(asked).collect();
    either("200", streams.iter_mut().map(|stream| answer(stream).answer))
}

/// Each answer is this one or that the server is busy.
fn either(good: &str, answers: impl Iterator<Item = String>) -> Reply {
    let answers: BTreeSet<String> = answers.collect();
    assert!(answers.contains(good), "{answers:?}");
    assert!(answers.iter().all(|answer| answer == good || answer == "503"), "{answers:?}");
    Reply::summary(format!("{good} or 503"))
}

/// Threads that ask at once, each over a connection of its own.
pub(crate) fn many_threads(site: &Site) -> Reply {
    let one = || site.send(&post("/api/benches", r#"{"from":"given"}"#)).answer;
    thread::scope(|scope| {
        let asked: Vec<_> = (0..40).map(|_| scope.spawn(one)).collect();
        either("201", asked.into_iter().map(|thread| thread.join().unwrap()))
    })
}

/// Tabs that each open a bench; only the last few are kept.
pub(crate) fn many_tabs(site: &Site) -> Reply {
    let ids: Vec<String> = (0..20).map(|_| site.open()).collect();
    let view = |id: &String| site.send(&post(&format!("/api/benches/{id}/view"), "{}")).answer;
    let (old, new) = ids.split_at(ids.len() - PLACES.0);
    assert!(new.iter().all(|id| view(id) == "200"), "the last {} are kept", PLACES.0);
    assert!(old.iter().all(|id| view(id) == "410"), "older ones are known and gone");
    site.send(&post(&format!("/api/benches/{}/view", ids[0]), "{}"))
}

/// Two requests in one go are two answers.
pub(crate) fn pipelined(site: &Site) -> Reply {
    let first = site.bytes(&get("/api/catalogue").without("Connection"));
    let mut stream = site.connect();
    stream.write_all(&[first, site.bytes(&get("/absent"))].concat()).unwrap();
    let mut bytes = vec![];
    let _ = stream.read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes);
    let statuses: Vec<&str> =
        text.split("HTTP/1.1 ").skip(1).filter_map(|part| part.split(' ').next()).collect();
    Reply::summary(statuses.join(", then "))
}
