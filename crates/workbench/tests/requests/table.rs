//! Requests and what they are answered.

use crate::acts;
use crate::site::{Ask, BYTES, Reply, Site, ask, get, post};

/// How a row asks.
pub(crate) enum Does {
    /// One request.
    Asks(Ask),
    /// These very bytes.
    Sends(Vec<u8>),
    /// One request about a bench that was opened just before; `{bench}` in its path is the id.
    Uses(fn(&str) -> Ask),
    /// Something longer.
    Acts(fn(&Site) -> Reply),
}

/// A request, and its answer.
pub(crate) struct Row {
    pub(crate) what: &'static str,
    pub(crate) answer: &'static str,
    pub(crate) does: Does,
}

/// Rows under a heading.
pub(crate) type Part = (&'static str, Vec<Row>);

fn asks(what: &'static str, answer: &'static str, request: Ask) -> Row {
    Row { what, answer, does: Does::Asks(request) }
}

fn sends(what: &'static str, answer: &'static str, bytes: impl Into<Vec<u8>>) -> Row {
    Row { what, answer, does: Does::Sends(bytes.into()) }
}

fn uses(what: &'static str, answer: &'static str, request: fn(&str) -> Ask) -> Row {
    Row { what, answer, does: Does::Uses(request) }
}

fn acts(what: &'static str, answer: &'static str, act: fn(&Site) -> Reply) -> Row {
    Row { what, answer, does: Does::Acts(act) }
}

/// All of them.
pub(crate) fn parts() -> Vec<Part> {
    vec![
        ("Who sends the request", who()),
        ("Path and method", paths()),
        ("Content", sent()),
        ("Answers of the engine", engine()),
        ("Time and number", limits()),
        ("Invalid HTTP", not_http()),
    ]
}

const CATALOGUE: &str = "/api/catalogue";
const BENCHES: &str = "/api/benches";
const GIVEN: &str = r#"{"from":"given"}"#;

fn who() -> Vec<Row> {
    let host = |line| get("/").but(line);
    let origin = |line| get(CATALOGUE).with(line);
    let token = |line| get(CATALOGUE).but(line);
    vec![
        asks("the page, without a token", "200", get("/").without("Authorization")),
        asks("the catalogue, with the token", "200", get(CATALOGUE)),
        asks("host name localhost", "200", host("Host: localhost:{port}")),
        asks("address [::1]", "200", host("Host: [::1]:{port}")),
        asks("no Host", "403", get("/").without("Host")),
        asks("Host of a foreign page", "403", host("Host: evil.example")),
        asks("foreign Host with the right port", "403", host("Host: evil.example:{port}")),
        asks("Host of another port", "403", host("Host: 127.0.0.1:1")),
        asks("Host without the port", "403", host("Host: 127.0.0.1")),
        asks("Host with a dot at the end", "403", host("Host: localhost.:{port}")),
        asks("Host with a name before it", "403", host("Host: evil@127.0.0.1:{port}")),
        asks("two Hosts", "403", get("/").with("Host: evil.example")),
        asks("own Host, target on another host", "403", get("http://evil.example/")),
        asks("own Host, absolute target of this server", "200", get("http://127.0.0.1:{port}/")),
        asks("own Origin", "200", origin("Origin: http://127.0.0.1:{port}")),
        asks("foreign Origin", "403", origin("Origin: http://evil.example")),
        asks("Origin null, as of a sandboxed frame or a file", "403", origin("Origin: null")),
        asks("Origin with another scheme", "403", origin("Origin: https://127.0.0.1:{port}")),
        asks("Origin of another port", "403", origin("Origin: http://127.0.0.1:1")),
        asks("empty Origin", "403", origin("Origin:")),
        asks(
            "preflight request of a foreign Origin",
            "403",
            ask("OPTIONS", BENCHES)
                .with("Origin: http://evil.example")
                .with("Access-Control-Request-Method: POST")
                .without("Authorization"),
        ),
        asks("no token", "401", get(CATALOGUE).without("Authorization")),
        asks("wrong token", "401", token(&format!("Authorization: Bearer {}", "0".repeat(64)))),
        asks("token with an extra digit", "401", token("Authorization: Bearer {token}0")),
        asks("empty token", "401", token("Authorization: Bearer ")),
        asks("token as a password", "401", token("Authorization: Basic {token}")),
        asks("token in the path", "401", get("/api/catalogue?token={token}").without("Authorization")),
        asks("token twice", "401", get(CATALOGUE).with("Authorization: Bearer {token}")),
        asks(
            "foreign Host and no token",
            "403",
            get(CATALOGUE).but("Host: evil.example").without("Authorization"),
        ),
    ]
}

fn paths() -> Vec<Row> {
    let long = format!("/{}", "a".repeat(20_000));
    vec![
        asks("HEAD of the page", "200", ask("HEAD", "/")),
        acts("a page the browser has cached", "304", acts::known_page),
        asks("a page cached in another version", "200", get("/").with("If-None-Match: \"0\"")),
        asks("a path that does not exist", "404", get("/absent")),
        asks("a path that does not exist, under /api", "404", get("/api/absent")),
        asks("the same without a token", "401", get("/api/absent").without("Authorization")),
        asks("parent folder", "404", get("/../Cargo.toml")),
        asks("many folders up", "404", get("/../../../../../../etc/passwd")),
        asks("parent folder, encoded", "404", get("/%2e%2e%2fCargo.toml")),
        asks("parent folder, encoded twice", "404", get("/%252e%252e%252fCargo.toml")),
        asks("parent folder, with backslashes", "404", get("/..\\..\\Cargo.toml")),
        asks("parent folder, from under /api", "401", get("/api/../index.html").without("Authorization")),
        asks("two slashes at the start", "404", get("//etc/passwd")),
        asks("a path with %00", "404", get("/index.html%00.js")),
        sends("a path with NUL", "400", b"GET /\0 HTTP/1.1\r\nHost: x\r\n\r\n"),
        asks("a path of 20 000 letters", "404", get(&long)),
        asks("a source file of the program", "404", get("/src/lib.rs")),
        asks("POST to the page", "405", post("/", "{}")),
        asks("POST to the catalogue", "405", post(CATALOGUE, "{}")),
        asks("GET of the benches", "405", get(BENCHES)),
        asks("DELETE of a bench", "405", ask("DELETE", "/api/benches/1/view")),
        asks("an unknown method", "405", ask("BREW", "/")),
        asks("a TRACE request", "405", ask("TRACE", "/")),
        asks("a tunnel", "403", ask("CONNECT", "evil.example:443")),
        asks("wrong method and no token", "401", get(BENCHES).without("Authorization")),
        asks("wrong method and wrong content type", "405", ask("PUT", BENCHES).body("x")),
    ]
}

fn sent() -> Vec<Row> {
    let open = |body: &str| post(BENCHES, body);
    let large = "x".repeat(BYTES + 1);
    let deep = format!(r#"{{"from":"case","id":{}"#, "[".repeat(50_000));
    vec![
        asks("JSON with a charset", "201", open(GIVEN).but("Content-Type: application/json; charset=utf-8")),
        asks("JSON in chunks", "201", open("").chunked(GIVEN.as_bytes())),
        asks("no content type", "415", open(GIVEN).without("Content-Type")),
        asks("text", "415", open(GIVEN).but("Content-Type: text/plain")),
        asks("a form", "415", open(GIVEN).but("Content-Type: application/x-www-form-urlencoded")),
        asks("almost JSON", "415", open(GIVEN).but("Content-Type: application/jsonp")),
        asks("too large, with its length stated", "413", open(&large)),
        asks("too large, in chunks", "413", open("").chunked(large.as_bytes())),
        asks("far too large, nothing sent", "413", open("").but("Content-Length: 99999999999999")),
        acts("eight megabytes, refused unread", "401", acts::unwanted),
        asks("too large and of the wrong content type", "415", open(&large).but("Content-Type: text/plain")),
        asks("empty body", "400", open("")),
        asks("garbage", "400", open("\u{1}\u{2}{{")),
        asks("truncated JSON", "400", open(r#"{"from":"#)),
        asks("JSON with trailing text", "400", open(r#"{"from":"given"} x"#)),
        asks("JSON of the wrong shape", "400", open("[1, 2]")),
        asks("an unknown key", "400", open(r#"{"from":"given","path":"/etc/passwd"}"#)),
        asks("a key twice", "400", open(r#"{"from":"case","id":"a","id":"b"}"#)),
        asks("a number instead of a text", "400", open(r#"{"from":"case","id":7}"#)),
        asks(
            "a number out of range",
            "400",
            open(r#"{"from":"simulation","machine":"m","plan":"p","effects":[],"distance":1e999}"#),
        ),
        asks("JSON nested 50 000 deep", "400", open(&deep)),
        asks("text that is not UTF-8", "400", post(BENCHES, b"{\"from\":\"case\",\"id\":\"\xff\xfe\"}")),
        asks("text in UTF-16", "400", post(BENCHES, b"{\0\"\0f\0")),
        asks("compressed JSON", "400", post(BENCHES, [0x1f, 0x8b, 8, 0, 0]).with("Content-Encoding: gzip")),
        asks(
            "a name with folders in it",
            "201",
            open(
                r#"{"from":"files","hexapod":{"name":"../../etc/passwd","text":""},"data":{"name":"<script>","text":""},"holdout":null}"#,
            ),
        ),
    ]
}

fn engine() -> Vec<Row> {
    let files = |data: &str| {
        let text = |text: &str| serde_json::json!({ "name": "a.csv", "text": text });
        post(
            BENCHES,
            serde_json::json!({ "from": "files", "hexapod": text(""), "data": text(data), "holdout": null })
                .to_string(),
        )
    };
    vec![
        asks("a bench", "201", post(BENCHES, GIVEN)),
        uses("a check of its files", "200", |id| post(&format!("/api/benches/{id}/check"), "{}")),
        uses("its view", "200", |id| post(&format!("/api/benches/{id}/view"), r#"{"terms":["creep"]}"#)),
        uses("terms added to a model one at a time", "200", |id| {
            post(&format!("/api/benches/{id}/trials"), r#"{"each":["creep"],"terms":[]}"#)
        }),
        uses("what the residuals of a model follow", "200", |id| {
            post(&format!("/api/benches/{id}/followed"), r#"{"terms":["creep"]}"#)
        }),
        uses("a model in one picture", "200", |id| {
            post(&format!("/api/benches/{id}/picture"), r#"{"terms":["creep"]}"#)
        }),
        uses("the readings to take next", "200", |id| {
            post(&format!("/api/benches/{id}/plan"), r#"{"choice":{"number":4,"repeats":[2,0]}}"#)
        }),
        uses("fewer than no readings", "400", |id| {
            post(&format!("/api/benches/{id}/plan"), r#"{"choice":{"number":-1}}"#)
        }),
        uses("nothing to try", "400", |id| post(&format!("/api/benches/{id}/trials"), r#"{"terms":[]}"#)),
        asks("an unknown case", "404", post(BENCHES, r#"{"from":"case","id":"absent"}"#)),
        asks("a bad file", "422", files("bad")),
        asks("a file with too many readings", "413", files("long")),
        uses("a request this bench does not support", "409", |id| {
            post(&format!("/api/benches/{id}/reveal"), r#"{"guess":[]}"#)
        }),
        asks(
            "a request that makes the engine panic",
            "500",
            post(BENCHES, r#"{"from":"case","id":"falls-over"}"#),
        ),
        uses("a view that makes the engine panic", "500", |id| {
            post(&format!("/api/benches/{id}/view"), r#"{"terms":["falls-over"]}"#)
        }),
        asks("an id that was never issued", "404", post("/api/benches/1-0/view", "{}")),
        asks("an id that is a path", "404", post("/api/benches/..%2f..%2fetc/view", "{}")),
        asks("an id that is not UTF-8", "404", post("/api/benches/%ff/view", "{}")),
        asks("no id", "404", post("/api/benches//view", "{}")),
        uses("an export with an unknown key", "400", |id| {
            post(&format!("/api/benches/{id}/export"), r#"{"what":"model","terms":[],"path":"/tmp/x"}"#)
        }),
        uses("an export of unknown kind", "400", |id| {
            post(&format!("/api/benches/{id}/export"), r#"{"what":"shadow"}"#)
        }),
        uses("a session saved", "200", |id| {
            post(&format!("/api/benches/{id}/session"), r#"{"form":"file","steps":[],"at":0,"notes":""}"#)
        }),
        uses("a session saved in an unknown form", "400", |id| {
            post(&format!("/api/benches/{id}/session"), r#"{"form":"shadow","steps":[],"at":0,"notes":""}"#)
        }),
        uses("a session resumed", "200", |id| {
            post(&format!("/api/benches/{id}/resume"), r#"{"name":"session.json","text":"good"}"#)
        }),
        uses("a session that the engine refuses", "422", |id| {
            post(&format!("/api/benches/{id}/resume"), r#"{"name":"session.json","text":"bad"}"#)
        }),
        acts("the first bench of twenty tabs", "410", acts::many_tabs),
    ]
}

fn limits() -> Vec<Row> {
    vec![
        acts("half a head, then silence", "closed", acts::half_a_head),
        acts("a head one byte at a time", "closed", acts::slow_head),
        acts("a request, then silence", "200", acts::idle),
        acts("half a body, then silence", "408", acts::half_a_body),
        acts("a large answer that is not read", "broken off", acts::unread),
        acts("a computation over the time limit", "503", acts::long_computation),
        acts("a search over the time limit", "503", acts::stopped_computation),
        acts("a search whose page is closed", "stopped", acts::gone_while_computing),
        acts("a request that waits too long for others", "503", acts::long_wait),
        acts("a request when the queue is full", "503", acts::full_queue),
        acts("a request after many that were abandoned while waiting", "201", acts::gone_while_waiting),
        acts("500 connections at once", "200 or 503", acts::many_connections),
        acts("40 requests at once", "201 or 503", acts::many_threads),
    ]
}

fn not_http() -> Vec<Row> {
    let many = (0..200).fold(get("/"), |request, n| request.with(format!("X-{n}: 1")));
    let both = post(BENCHES, "").chunked(GIVEN.as_bytes()).with("Content-Length: 3");
    vec![
        sends("nothing, then silence", "closed", ""),
        sends("letters", "400", "hello?\r\n\r\n"),
        sends(
            "the start of a TLS connection",
            "400",
            b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
        ),
        sends("the start of HTTP/2", "closed", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
        sends("HTTP/0.9", "400", "GET /\r\n\r\n"),
        asks("HTTP/1.0", "200", get("/").old()),
        asks("HTTP/1.0 without Host", "403", get("/").old().without("Host")),
        asks("a head of 100 000 letters", "431", get("/").with(format!("X-Long: {}", "a".repeat(100_000)))),
        asks("200 headers", "431", many),
        sends("a path of 100 000 letters", "431", format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(100_000))),
        asks("a line that is not a header", "400", get("/").with("no colon here")),
        asks("a negative length", "400", post(BENCHES, GIVEN).but("Content-Length: -1")),
        asks("two lengths", "400", post(BENCHES, GIVEN).with("Content-Length: 3")),
        asks("a length and chunks", "201", both),
        asks(
            "a chunk without a size",
            "400",
            post(BENCHES, "zz\r\n").without("Content-Length").with("Transfer-Encoding: chunked"),
        ),
        acts("two requests in one go", "200, then 404", acts::pipelined),
    ]
}
