//! `hexbench discover`: the law that no catalogue has, from files to a term that the diagnosis names.

use serde_json::Value;

use crate::support::{diagnose, hexbench_in, text};

const CASE: &str = "not-in-catalogue";

fn discover(case: &str, more: &[&str]) -> std::process::Output {
    let files = ["discover", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    hexbench_in(case).args(files).args(more).output().unwrap()
}

#[test]
fn outside_then_a_law_then_named() {
    let folder = tempfile::tempdir().unwrap();
    let term = folder.path().join("term.toml");
    let term = term.to_str().unwrap();
    let outside = text(diagnose(CASE, &[]));
    assert!(outside.contains("OUTSIDE") && outside.contains("hexbench discover"), "{outside}");
    let page = text(discover(CASE, &["-o", term]));
    assert!(page.contains("LAW FOUND") && page.contains("8.00 mm"), "{page}");
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    let named = text(diagnose(CASE, &["--term", term, "--check=named"]));
    assert!(named.contains("it is at the noise"), "{named}");
}

#[test]
fn the_file_of_a_discovery_has_its_keys() {
    let told: Value = serde_json::from_str(&text(discover(CASE, &["--json", "-"]))).unwrap();
    assert_eq!(told["format"], "discovery/1");
    assert_eq!((&told["found"], &told["reason"]), (&Value::from(true), &Value::from("law")));
    let law = &told["laws"][0];
    assert_eq!(
        (&law["id"], &law["kind"], &law["legs"]),
        (&"law-1".into(), &"elongation".into(), &"all".into())
    );
    assert!(law["formula"].as_str().unwrap().contains("sin(2*pi*q/period)"), "{law}");
    assert!(law["held_out"]["after"].as_f64() < law["held_out"]["before"].as_f64(), "{law}");
    assert_eq!(law["look_at"].as_array().map(Vec::len), Some(3));
}

#[test]
fn the_page_for_a_browser_shows_the_law_through_the_residuals() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    text(discover(CASE, &["--html", path.to_str().unwrap()]));
    let page = std::fs::read_to_string(path).unwrap();
    for piece in ["LAW FOUND", "folded at that period", "Periodogram"] {
        assert!(page.contains(piece), "{piece}");
    }
}

#[test]
fn without_a_law_no_term_file_is_written_and_the_page_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let term = folder.path().join("term.toml");
    let output = discover("mujoco-clean", &["-o", term.to_str().unwrap()]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(text(output).contains("Nothing is missing"), "{told}");
    assert!(told.contains("no law was found") && !term.exists(), "{told}");
}
