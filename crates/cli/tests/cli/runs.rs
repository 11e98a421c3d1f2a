//! `hexbench runs`: two results beside each other.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{complaint, hexbench, hexbench_in, text};

/// The result of a command on a case, as a file.
fn result(folder: &Path, name: &str, case: &str, command: &[&str]) -> PathBuf {
    let file = folder.join(name);
    text(hexbench_in(case).args(command).arg("--json").arg(&file).output().unwrap());
    file
}

const DIAGNOSE: [&str; 5] = ["diagnose", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
const COMPARE: [&str; 3] = ["compare", "hexapod.toml", "measurements.csv"];

fn runs(a: &Path, b: &Path, more: &[&str]) -> std::process::Output {
    hexbench().arg("runs").arg(a).arg(b).args(more).output().unwrap()
}

fn ended(a: &Path, b: &Path) -> (Option<i32>, String) {
    let output = runs(a, b, &[]);
    (output.status.code(), complaint(&output))
}

/// The file with one text replaced.
fn altered(file: &Path, from: &str, to: &str) -> PathBuf {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{} lacks {from}", file.display());
    let path = file.with_extension("altered.json");
    fs::write(&path, text.replace(from, to)).unwrap();
    path
}

#[test]
fn a_run_beside_itself_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let a = result(folder.path(), "a.json", "mujoco-foundation", &DIAGNOSE);
    let page = text(runs(&a, &a, &["--check"]));
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("What changed from A to B UNCHANGED"), "{words}");
    for run in ["A", "B"] {
        assert!(words.contains(&format!("{run} named: base-compliance")), "{words}");
    }
    assert!(words.contains("0 of ") && words.contains("they share their noise"), "{words}");
    assert!(page.lines().all(|l| l.chars().count() <= 80 || l.contains(".json")), "{page}");
}

#[test]
fn what_changed_beyond_chance_is_marked_on_both_pages_and_in_the_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let a = result(folder.path(), "a.json", "mujoco-foundation", &DIAGNOSE);
    let json: Value = serde_json::from_str(&fs::read_to_string(&a).unwrap()).unwrap();
    let leg = json["parameters"].as_array().unwrap().iter().find(|p| p["name"] == "leg-3.stiffness").unwrap();
    let value = leg["value"].to_string();
    let b = altered(&a, &value, &format!("{}", 1.5 * leg["value"].as_f64().unwrap()));
    let html = folder.path().join("runs.html");
    let numbers = folder.path().join("runs.json");
    let more = ["--html", html.to_str().unwrap(), "--json", numbers.to_str().unwrap()];
    let page = text(runs(&a, &b, &more));
    let row = page.lines().find(|l| l.contains("leg-3.stiffness")).unwrap();
    assert!(row.ends_with('*') && page.matches(" *\n").count() == 1, "{page}");
    let html = fs::read_to_string(html).unwrap();
    // Three charts, each drawn for a wide window and for a narrow one.
    let drawn = ["<figure", "<svg"].map(|tag| html.matches(tag).count());
    assert!(html.contains(">CHANGED</span>") && drawn == [3, 6], "{}: {drawn:?}", html.len());
    let numbers: Value = serde_json::from_str(&fs::read_to_string(numbers).unwrap()).unwrap();
    let changed = numbers["parameters"].as_array().unwrap().iter().filter(|p| p["changed"] == "yes").count();
    crate::schemas::check("runs/1", std::slice::from_ref(&numbers));
    assert_eq!((numbers["format"].as_str(), changed), (Some("runs/1"), 1));
    assert_eq!(runs(&a, &b, &["--check"]).status.code(), Some(1));
}

#[test]
fn comparisons_are_put_beside_each_other_too() {
    let folder = tempfile::tempdir().unwrap();
    let a = result(folder.path(), "a.json", "contact", &COMPARE);
    let page = text(runs(&a, &a, &[]));
    assert!(page.contains("springs alone") && !page.contains("Parameters"), "{page}");
}

/// Held-out readings in one of them only: the page says so, and draws no bars beside each other.
#[test]
fn errors_that_are_not_compared_are_not_drawn_either() {
    let folder = tempfile::tempdir().unwrap();
    let held = result(folder.path(), "a.json", "mujoco-clean", &DIAGNOSE);
    let alone: Vec<&str> = DIAGNOSE.iter().copied().filter(|word| !word.contains("holdout")).collect();
    let alone = result(folder.path(), "b.json", "mujoco-clean", &alone);
    for (b, is_drawn) in [(&held, true), (&alone, false)] {
        let page = folder.path().join("runs.html");
        text(runs(&held, b, &["--html", page.to_str().unwrap()]));
        let page = fs::read_to_string(page).unwrap();
        assert_eq!(page.contains("Error of the first and of the final model of each run"), is_drawn);
        assert_eq!(page.contains("their errors are not compared"), !is_drawn);
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let a = result(folder.path(), "a.json", "mujoco-clean", &DIAGNOSE);
    let other_kind = result(folder.path(), "c.json", "mujoco-clean", &COMPARE);
    let other_machine = result(folder.path(), "m.json", "contact", &DIAGNOSE);
    for (b, reason) in [
        (&other_kind, "only files of the same format can be compared"),
        (&other_machine, "are about different machines"),
        (&altered(&a, "diagnosis/1", "diagnosis/2"), "format \"diagnosis/2\" is not read here"),
        (&altered(&other_kind, "\"readings\"", "{"), "not valid JSON: key must be a string"),
        (&folder.path().join("none.json"), "cannot be read"),
    ] {
        let (code, told) = ended(&a, b);
        assert!(told.contains(reason) && told.contains("next: "), "{told}");
        assert_eq!(code, Some(if reason == "cannot be read" { 5 } else { 3 }), "{told}");
    }
    let kind = altered(&a, "\"measurand\": \"deflections\"", "\"measurand\": \"absolute poses\"");
    assert!(ended(&a, &kind).1.contains("different kinds of readings"));
}

#[test]
fn a_file_of_an_older_version_is_taken_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let a = result(folder.path(), "a.json", "mujoco-clean", &DIAGNOSE);
    let mut json: Value = serde_json::from_str(&fs::read_to_string(&a).unwrap()).unwrap();
    json.as_object_mut().unwrap().remove("run");
    let old = folder.path().join("old.json");
    fs::write(&old, json.to_string()).unwrap();
    let words = text(runs(&a, &old, &[])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("whether it belongs beside the other one was not checked"), "{words}");
}

#[test]
fn results_of_other_kinds_without_holdout_or_dates_fit_their_schemas() {
    let folder = tempfile::tempdir().unwrap();
    let case = "mujoco-foundation";
    let read = |file: &Path| serde_json::from_str::<Value>(&fs::read_to_string(file).unwrap()).unwrap();
    let numbers = |files: &[PathBuf]| {
        let all = folder.path().join("runs.json");
        text(hexbench().arg("runs").args(files).arg("--json").arg(&all).output().unwrap());
        read(&all)
    };
    let fit = ["fit", "hexapod.toml", "measurements.csv"];
    let all: Vec<Value> = [&COMPARE[..], &fit, &DIAGNOSE[..3]]
        .into_iter()
        .map(|command| result(folder.path(), &format!("{}.json", command[0]), case, command))
        .map(|file| numbers(&[file.clone(), file]))
        .collect();
    crate::schemas::check("runs/1", &all);
    let diagnosis = result(folder.path(), "d.json", case, &DIAGNOSE);
    crate::schemas::check("book/1", &[numbers(&[diagnosis.clone(), diagnosis.clone(), diagnosis])]);
}
