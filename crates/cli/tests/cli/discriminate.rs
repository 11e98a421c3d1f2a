//! `hexbench discriminate` and its study.

use serde_json::Value;

use crate::support::{hexbench, root, text};

const CASE: &str = "data/cases/paper-protocol";

fn discriminate(more: &[&str]) -> std::process::Output {
    let mut command = hexbench();
    command.current_dir(root()).arg("discriminate").args([
        &format!("{CASE}/hexapod.toml"),
        "data/designs/effects-space.toml",
        "--between",
        "base-compliance",
    ]);
    command.args(more).output().unwrap()
}

#[test]
fn a_new_plan_is_told_saved_and_better_than_the_papers() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let json = folder.path().join("plan.json");
    let measured = format!("{CASE}/measurements.csv");
    let page = text(discriminate(&[
        "--between",
        "leg-coupling",
        "--readings",
        "9",
        "--against",
        &measured,
        "-o",
        plan.to_str().unwrap(),
        "--json",
        json.to_str().unwrap(),
    ]));
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("discriminate_new", page);
    let rows = std::fs::read_to_string(plan).unwrap();
    assert_eq!(rows.lines().count(), 1 + 9);
    let told: Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(told["format"], "discrimination/1");
    let least = |when: &str| {
        let distances = told["pairs"][0][when]["distance"].as_array().unwrap();
        distances.iter().map(|d| d.as_f64().unwrap()).fold(f64::INFINITY, f64::min)
    };
    assert!(least("after") > least("before"), "{} against {}", least("after"), least("before"));
}

#[test]
fn the_next_readings_exclude_one_of_two_that_the_data_leave_open() {
    let measured = format!("{CASE}/measurements.csv");
    let output = discriminate(&["--between", "leg-coupling", "--data", &measured, "--json", "-"]);
    let told: Value = serde_json::from_str(&text(output)).unwrap();
    let apart = text(discriminate(&["--between", "leg-coupling", "--readings", "2", "--json", "-"]));
    crate::schemas::check("discrimination/1", &[told.clone(), serde_json::from_str(&apart).unwrap()]);
    let pair = &told["pairs"][0];
    assert!(pair["log10_odds_in_hand"].as_f64().unwrap().abs() < 2.0, "{pair}");
    assert!(pair["readings_needed"].as_u64().unwrap() <= 6, "{pair}");
    let readings = told["readings"].as_array().unwrap();
    assert_eq!(readings.iter().map(|r| r["repeats"].as_u64().unwrap()).sum::<u64>(), 6);
    assert!(readings.iter().any(|r| r["text"].as_str().unwrap().contains("load sideways")), "{readings:?}");
}

#[test]
fn one_effect_alone_is_wrong_usage_and_an_unknown_one_is_told_its_neighbour() {
    let alone = discriminate(&[]);
    assert_eq!(alone.status.code(), Some(2));
    assert!(String::from_utf8(alone.stderr).unwrap().contains("--between TERM twice"));
    let unknown = discriminate(&["--between", "leg-copling"]);
    assert!(String::from_utf8(unknown.stderr).unwrap().contains("`leg-coupling`"));
}

#[test]
fn an_effect_without_its_conditions_is_refused() {
    let mut command = hexbench();
    let output = command
        .current_dir(root())
        .args(["discriminate", &format!("{CASE}/hexapod.toml"), "data/designs/paper-space.toml"])
        .args(["--between", "creep", "--between", "base-compliance"])
        .output()
        .unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(4), "{told}");
    assert!(told.contains("creep") && told.contains("elapsed_s"), "{told}");
}

#[test]
fn the_study_of_proposed_readings_writes_its_document() {
    let folder = tempfile::tempdir().unwrap();
    let document = folder.path().join("discriminate.md");
    let run = hexbench()
        .args(["validate", "discriminate", "--trials", "1", "--markdown", document.to_str().unwrap()])
        .output()
        .unwrap();
    let page = text(run);
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    let written = std::fs::read_to_string(document).unwrap();
    assert!(written.contains("## After the readings that the diagnosis proposes"), "{written}");
}
