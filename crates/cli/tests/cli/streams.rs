//! Standard output, standard error, color, closed pipes.

use std::io::Read;
use std::process::{Command, Stdio};

use crate::support::{complaint, diagnose, hexbench, root, text};

const ESCAPE: char = '\u{1b}';

#[test]
fn there_is_no_colour_off_a_terminal() {
    assert!(!text(hexbench().args(["demo", "--no-report"]).output().unwrap()).contains(ESCAPE));
}

#[test]
fn colour_can_be_asked_for_and_refused() {
    let coloured = text(hexbench().args(["demo", "--no-report", "--color", "always"]).output().unwrap());
    assert!(coloured.contains(ESCAPE));
    let refused = text(hexbench().args(["demo", "--no-report", "--color", "never"]).output().unwrap());
    assert!(!refused.contains(ESCAPE));
}

#[test]
fn no_color_is_respected() {
    let output = hexbench().args(["demo", "--no-report"]).env("NO_COLOR", "1").output().unwrap();
    assert!(!text(output).contains(ESCAPE));
}

#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let case = root().join("data/cases/mujoco-clean");
    let mut child = Command::new(env!("CARGO_BIN_EXE_hexbench"))
        .args(["diagnose", "hexapod.toml", "measurements.csv", "--json", "-"])
        .current_dir(case)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut complaints = String::new();
    child.stderr.take().unwrap().read_to_string(&mut complaints).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{complaints}");
    assert_eq!(complaints, "");
}

#[test]
fn warnings_about_a_file_go_to_standard_error() {
    let folder = tempfile::tempdir().unwrap();
    let case = root().join("data/cases/mujoco-clean");
    let rows = std::fs::read_to_string(case.join("measurements.csv")).unwrap();
    let data = folder.path().join("measurements.csv");
    std::fs::write(&data, rows.trim_end()).unwrap();
    let output = hexbench().arg("diagnose").arg(case.join("hexapod.toml")).arg(data).output().unwrap();
    assert!(complaint(&output).contains("warning: "));
    assert!(!text(output).contains("warning: "));
}

#[test]
fn json_on_standard_output_is_nothing_but_json() {
    let json = text(diagnose("mujoco-clean", &["--json", "-"]));
    assert!(serde_json::from_str::<serde_json::Value>(&json).is_ok());
}

#[test]
fn completions_exist_for_the_usual_shells() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = text(hexbench().args(["completions", shell]).output().unwrap());
        assert!(script.contains("diagnose"), "{shell}");
    }
}

#[test]
fn the_same_data_give_the_same_bytes() {
    let run = || text(diagnose("two-effects", &["--json", "-"]));
    assert_eq!(run(), run());
}
