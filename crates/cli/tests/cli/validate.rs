//! `validate`: studies with a known truth, as a user runs them.

use std::fs;
use std::path::Path;

use crate::support::{hexbench, text};

/// One trial of each kind.
const FEW: [&str; 4] = ["validate", "calibration", "--trials", "7"];

fn files_of(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap()))
        .collect();
    all.sort();
    all
}

#[test]
fn a_calibration_writes_trials_tables_charts_and_a_document_whose_charts_exist() {
    let folder = tempfile::tempdir().unwrap();
    let (out, markdown) = (folder.path().join("study"), folder.path().join("docs/calibration.md"));
    let mut command = hexbench();
    let page = text(command.args(FEW).arg("-o").arg(&out).arg("--markdown").arg(&markdown).output().unwrap());
    assert!(page.contains("An effect that is not there was named in"), "{page}");
    assert!(page.lines().filter(|l| !l.contains('/')).all(|l| l.chars().count() <= 80), "{page}");
    let names: Vec<String> = files_of(&out).into_iter().map(|(name, _)| name).collect();
    for wanted in ["trials.csv", "confusion.csv", "reliability.csv", "power.svg", "confusion.svg"] {
        assert!(names.iter().any(|n| n == wanted), "{wanted} in {names:?}");
    }
    let document = fs::read_to_string(&markdown).unwrap();
    let charts: Vec<&str> =
        document.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(path, _)| path).collect();
    assert!(charts.len() >= 4, "{charts:?}");
    for chart in charts {
        assert!(folder.path().join("docs").join(chart).is_file(), "{chart}");
    }
}

#[test]
fn the_same_seed_writes_the_same_files_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let files = |name: &str, threads: &str| {
        let out = folder.path().join(name);
        let mut command = hexbench();
        command.env("RAYON_NUM_THREADS", threads).args(FEW).args(["--seed", "5", "-o"]).arg(&out);
        assert!(command.output().unwrap().status.success());
        files_of(&out)
    };
    assert!(files("a", "1") == files("b", "3"), "the files differ");
}

#[test]
fn one_trial_is_written_as_files_that_the_diagnosis_reads() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = hexbench();
    let line = text(
        command
            .args(["validate", "calibration", "--case", "single-0008", "-o"])
            .arg(folder.path())
            .output()
            .unwrap(),
    );
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(words[0], "hexbench", "{line}");
    hexbench().args(&words[1..]).assert().success();
    assert!(folder.path().join("single-0008/truth.json").is_file());
}

#[test]
fn a_trial_that_is_none_is_wrong_usage() {
    for bad in ["pair", "pairs-0001", "pair-x", "pair-99999999999"] {
        let mut command = hexbench();
        let output = command.args(["validate", "calibration", "--case", bad, "-o", "x"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{bad}");
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(stderr.contains(bad) && stderr.contains("pair-0007"), "{stderr}");
    }
    hexbench().args(["validate", "calibration", "--trials", "0", "-o", "x"]).assert().code(2);
}

/// A clean machine in the hands of a careful laboratory and of one with a wrong number.
const FAULTY: [&str; 6] = ["validate", "robustness", "--trials", "1", "--fault", "outlier-60"];

#[test]
fn robustness_writes_trials_tables_and_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let (out, markdown) = (folder.path().join("study"), folder.path().join("docs/robustness.md"));
    let mut command = hexbench();
    let page =
        text(command.args(FAULTY).arg("-o").arg(&out).arg("--markdown").arg(&markdown).output().unwrap());
    assert!(page.contains("one number off by 60 sigma"), "{page}");
    let names: Vec<String> = files_of(&out).into_iter().map(|(name, _)| name).collect();
    for wanted in
        ["trials.csv", "violations.csv", "findings.csv", "counts.csv", "verdicts.csv", "mistakes.csv"]
    {
        assert!(names.iter().any(|n| n == wanted), "{wanted} in {names:?}");
    }
    let trials = fs::read_to_string(out.join("trials.csv")).unwrap();
    assert_eq!(trials.lines().count(), 3, "{trials}");
    let document = fs::read_to_string(&markdown).unwrap();
    assert!(
        document.contains("hexbench validate robustness") && document.contains("outlier-60"),
        "{document}"
    );
}

/// One machine whose readings have the opposite sign, and a sound one.
const MISREAD: [&str; 8] =
    ["validate", "misread", "--trials", "1", "--sound", "1", "--misstatement", "deflection-negated"];

#[test]
fn misread_writes_trials_tables_and_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let (out, markdown) = (folder.path().join("study"), folder.path().join("docs/misread.md"));
    let mut command = hexbench();
    let page =
        text(command.args(MISREAD).arg("-o").arg(&out).arg("--markdown").arg(&markdown).output().unwrap());
    assert!(page.contains("deflection-negated"), "{page}");
    let names: Vec<String> = files_of(&out).into_iter().map(|(name, _)| name).collect();
    for wanted in ["trials.csv", "misstatements.csv", "families.csv", "plans.csv", "false-alarms.csv"] {
        assert!(names.iter().any(|n| n == wanted), "{wanted} in {names:?}");
    }
    let trials = fs::read_to_string(out.join("trials.csv")).unwrap();
    assert_eq!(trials.lines().count(), 3, "{trials}");
    let document = fs::read_to_string(&markdown).unwrap();
    let banner = "Written by `hexbench validate misread --markdown FILE`; do not edit.";
    assert_eq!(document.lines().nth(2), Some(banner), "{document}");
}

#[test]
fn a_misread_campaign_is_written_as_files_that_the_diagnosis_reads() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = hexbench();
    let case = ["validate", "misread", "--case", "wrench-yaw-90/ring_c-clean-0001", "-o"];
    let line = text(command.args(case).arg(folder.path()).output().unwrap());
    let words: Vec<&str> = line.split_whitespace().collect();
    hexbench().args(&words[1..]).assert().success();
    hexbench().args(["validate", "misread", "--case", "magic/ring_c-clean-0001", "-o", "x"]).assert().code(2);
    hexbench().args(["validate", "misread", "--misstatement", "magic", "-o", "x"]).assert().code(2);
}

#[test]
fn a_campaign_with_a_fault_is_written_as_files_that_the_diagnosis_reads() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = hexbench();
    let case = ["validate", "robustness", "--case", "temperature/clean-0001", "-o"];
    let line = text(command.args(case).arg(folder.path()).output().unwrap());
    let words: Vec<&str> = line.split_whitespace().collect();
    hexbench().args(&words[1..]).assert().success();
    let truth = fs::read_to_string(folder.path().join("temperature-clean-0001/truth.json")).unwrap();
    assert!(truth.contains("\"laboratory\""), "{truth}");
    hexbench().args(["validate", "robustness", "--case", "magic/clean-0001", "-o", "x"]).assert().code(2);
    hexbench().args(["validate", "robustness", "--fault", "magic", "-o", "x"]).assert().code(2);
}
