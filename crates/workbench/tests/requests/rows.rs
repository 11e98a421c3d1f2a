//! Every row is answered as the table says, and the server goes on. `docs/reference/workbench-requests.md` is made from the answers.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use crate::site::{Reply, Site, get};
use crate::table::{Does, Row, parts};

/// Refused before they are requests: such answers have neither body nor our headers.
const OF_THE_PROTOCOL: [&str; 2] = ["400", "431"];
/// In every answer.
const ALWAYS: [&str; 6] = [
    "content-security-policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
     connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "x-content-type-options: nosniff",
    "referrer-policy: no-referrer",
    "cross-origin-opener-policy: same-origin",
    "cross-origin-resource-policy: same-origin",
    "x-frame-options: DENY",
];

const OPENING: &str = "# Requests to the workbench\n\n\
    Written by `HEXBENCH_BLESS=1 cargo test -p hexbench-workbench --test requests`; do not edit.\n\n\
    Valid and invalid requests with their answers. The tests send these requests over plain sockets. The server under test has a\n\
    test engine, accepts 65 536 bytes at most, and waits a second or less where the real server waits longer\n\
    ([limits](../guide/workbench.md#limits)). After every row it must still serve the catalogue.\n\n\
    `closed`: the connection ends without an answer. Answers to invalid HTTP without a message come from the HTTP library.\n";

fn reply(row: &Row, site: &Site) -> Reply {
    match &row.does {
        Does::Asks(request) => site.send(request),
        Does::Sends(bytes) => site.exchange(bytes),
        Does::Uses(request) => site.send(&request(&site.open())),
        Does::Acts(act) => act(site),
    }
}

/// A faultless answer has our headers, allows no other origin anything, and says what to do when it says no.
fn faults(row: &Row, reply: &Reply) -> Vec<String> {
    let mut faults = vec![];
    if reply.answer != row.answer {
        faults.push(format!("answered {}, not {}", reply.answer, row.answer));
    }
    let of_the_protocol = OF_THE_PROTOCOL.contains(&reply.answer.as_str()) && reply.body.is_empty();
    if reply.head.is_empty() || of_the_protocol {
        return faults;
    }
    let missing = ALWAYS.iter().filter(|line| !reply.head.iter().any(|l| l == *line));
    faults.extend(missing.map(|line| format!("lacks {line}")));
    if reply.header("cache-control").is_none() {
        faults.push("says nothing about caches".into());
    }
    if reply.head.iter().any(|line| line.starts_with("access-control-")) {
        faults.push("lets another origin in".into());
    }
    let refused = reply.answer.parse::<u16>().is_ok_and(|status| status >= 400);
    let said = |key| reply.text(key).is_some_and(|text| !text.is_empty());
    if refused && !(said("error") && said("next")) {
        faults.push("does not say why and what to do".into());
    }
    for (status, header) in [("405", "allow"), ("401", "www-authenticate"), ("503", "retry-after")] {
        if reply.answer == status && reply.header(header).is_none() {
            faults.push(format!("lacks {header}"));
        }
    }
    faults
}

/// The catalogue is answered; right after many connections it may take a moment.
fn goes_on(site: &Site) -> bool {
    site.patiently(&get("/api/catalogue")).answer == "200"
}

fn line(row: &Row, reply: &Reply) -> String {
    let cell = |key| reply.text(key).unwrap_or_default().replace('|', "\\|");
    format!("| {} | {} | {} | {} |", row.what, reply.answer, cell("error"), cell("next"))
}

#[test]
fn every_request_is_answered_as_documented_and_the_server_goes_on() {
    let site = Site::start();
    let (mut document, mut failed) = (OPENING.to_owned(), vec![]);
    for (heading, rows) in parts() {
        writeln!(document, "\n## {heading}\n\n| request | answer | message | next step |\n|---|---|---|---|")
            .unwrap();
        for row in rows {
            let reply = reply(&row, &site);
            let mut faults = faults(&row, &reply);
            if !goes_on(&site) {
                faults.push("the server does not answer any more".into());
            }
            failed.extend(faults.into_iter().map(|fault| format!("{heading}: {}: {fault}", row.what)));
            writeln!(document, "{}", line(&row, &reply)).unwrap();
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    compare(&document);
}

fn compare(document: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/workbench-requests.md");
    if std::env::var_os("HEXBENCH_BLESS").is_some() {
        fs::write(&path, document).unwrap();
    }
    let stored = fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(stored == document, "docs/reference/workbench-requests.md is stale: run with HEXBENCH_BLESS=1");
}
