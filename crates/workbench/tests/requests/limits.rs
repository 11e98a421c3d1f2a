//! The limits in the documents are those of the program.

use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use hexbench_workbench::server::ServerSettings;

/// Digits in groups of three.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).unwrap()).collect();
    groups.join(" ")
}

#[test]
fn the_page_about_the_workbench_states_the_limits_of_the_program() {
    let s = ServerSettings::default();
    let seconds = |time: Duration| usize::try_from(time.as_secs()).unwrap();
    let stated = [
        ("bytes of a request", s.limits.bytes),
        ("readings of a file", s.limits.rows),
        ("your own terms in a request", s.limits.own_terms),
        ("bytes of one of them", s.limits.term_bytes),
        ("benches kept", s.limits.benches),
        ("bytes of the files behind them", s.kept_bytes),
        ("computations at once", s.computing),
        ("requests that wait", s.waiting),
        ("seconds they wait", seconds(s.wait)),
        ("seconds a client waits for its computation", seconds(s.compute)),
        ("connections", s.connections),
        ("connections that get that answer", s.turned_away),
        ("seconds for the head of a request, or without any", seconds(s.head)),
        ("seconds for its body", seconds(s.body)),
        ("seconds without a byte of the answer being taken", seconds(s.write)),
    ];
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide/workbench.md");
    let page = fs::read_to_string(path).unwrap();
    for (what, limit) in stated {
        let line = format!("| {what} | {} |", grouped(limit as u64));
        assert!(page.contains(&line), "docs/guide/workbench.md lacks {line}");
    }
}
