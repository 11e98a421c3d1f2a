//! `regress`: exit codes, files, and baselines that are refused.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{complaint, hexbench, text};

fn regress(baseline: &Path, more: &[&str]) -> Output {
    let mut command = hexbench();
    command.args(["regress", "--quick", "--baseline"]).arg(baseline).args(more).output().unwrap()
}

/// The text of a baseline of two runs of the quick suite.
fn baseline() -> &'static str {
    static MADE: OnceLock<String> = OnceLock::new();
    MADE.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/baseline.json");
        let told = text(regress(&path, &["--update", "--reason", "the first", "--runs", "2"]));
        assert!(told.contains("update 1"), "{told}");
        fs::read_to_string(path).unwrap()
    })
}

/// A folder with a baseline, changed by `change`.
fn changed(change: impl Fn(&mut Value)) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("baseline.json");
    let mut value: Value = serde_json::from_str(baseline()).unwrap();
    change(&mut value);
    fs::write(&path, serde_json::to_string(&value).unwrap()).unwrap();
    (folder, path)
}

#[test]
fn an_unchanged_program_passes_with_the_same_values_and_writes_what_continuous_integration_reads() {
    let (folder, path) = changed(|_| ());
    let file = |name: &str| folder.path().join(name).display().to_string();
    let [junit, json, markdown] = ["limits.xml", "limits.json", "limits.md"].map(file);
    let files = ["--junit", &junit, "--json", &json, "--markdown", &markdown];
    let page = text(regress(&path, &files));
    assert!(page.contains("no significant change"), "{page}");
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    let result: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    crate::schemas::check("regress/1", std::slice::from_ref(&result));
    let findings = result["findings"].as_array().unwrap();
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(&format!("{0} of {0} limits", findings.len())), "{page}");
    assert!(findings.iter().all(|f| f["same_values"] == Value::Bool(true)));
    let junit = fs::read_to_string(&junit).unwrap();
    assert_eq!(junit.matches("<testcase ").count(), findings.len());
    assert!(!junit.contains("<failure"), "{junit}");
    assert!(fs::read_to_string(&markdown).unwrap().contains("Accuracy regression: passed"));
}

#[test]
fn a_change_beyond_chance_ends_with_exit_code_1_and_tells_figures_and_the_next_step() {
    let (folder, path) = changed(|baseline| {
        // Half the errors before, on the same machine.
        let values = &mut baseline["limits"]["exact-effect:target-offset"]["values"];
        values[0] = (0.5 * values[0].as_f64().unwrap()).into();
        // Leg stiffnesses a hundred times as accurate before.
        let error = &mut baseline["limits"]["stiffness-error"];
        let [n, sum, squares] = ["n", "sum", "squares"].map(|key| error[key].as_f64().unwrap());
        let shift = 100.0_f64.ln();
        error["sum"] = (sum - n * shift).into();
        error["squares"] = (squares - 2.0 * shift * sum + n * shift * shift).into();
    });
    let junit = folder.path().join("limits.xml");
    let output = regress(&path, &["--junit", &junit.display().to_string()]);
    assert_eq!(output.status.code(), Some(1), "{}", complaint(&output));
    assert!(complaint(&output).contains("significantly worse"), "{}", complaint(&output));
    let page = String::from_utf8(output.stdout).unwrap();
    for wanted in
        ["target-offset: its numbers without noise", "leg stiffness: relative error", "next:", "--update"]
    {
        assert!(page.contains(wanted), "{wanted} is not in\n{page}");
    }
    assert_eq!(fs::read_to_string(junit).unwrap().matches("<failure ").count(), 2);
}

#[test]
fn a_baseline_is_not_changed_without_a_reason_and_keeps_its_history() {
    let (_folder, path) = changed(|_| ());
    let before = fs::read(&path).unwrap();
    for more in [vec!["--update"], vec!["--update", "--reason", " "], vec!["--reason", "why"]] {
        let output = regress(&path, &more);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {}", complaint(&output));
        assert!(
            complaint(&output).contains("reason") || complaint(&output).contains("update"),
            "{}",
            complaint(&output)
        );
        assert!(fs::read(&path).unwrap() == before, "{more:?} changed the baseline");
    }
    text(regress(&path, &["--update", "--reason", "the second", "--runs", "1"]));
    let after: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    let reasons: Vec<&str> =
        after["history"].as_array().unwrap().iter().map(|u| u["reason"].as_str().unwrap()).collect();
    assert_eq!(reasons, ["the first", "the second"]);
}

#[test]
fn baselines_that_are_none_are_refused_with_the_place_and_the_next_step() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str); 6] = [
        (|b| b["suite_version"] = 0.into(), "was made with suite `quick/0`"),
        (|b| b["suite"] = "full".into(), "was made with suite `full/"),
        (|b| b["format"] = "regress-baseline/9".into(), "has the format `regress-baseline/9`"),
        (|b| drop(b["limits"].as_object_mut().unwrap().remove("misfits")), "lacks the limit `misfits`"),
        (|b| b["limits"]["misfits"]["hits"] = 999.into(), "limit `misfits`: 999 hits of"),
        (|b| b["surplus"] = 1.into(), "unknown key `surplus`"),
    ];
    for (change, wanted) in cases {
        let (_folder, path) = changed(change);
        let output = regress(&path, &[]);
        assert_eq!(output.status.code(), Some(3), "{wanted}: {}", complaint(&output));
        assert!(
            complaint(&output).contains(wanted) && complaint(&output).contains("next:"),
            "{}",
            complaint(&output)
        );
    }
    let (folder, path) = changed(|_| ());
    fs::write(&path, &baseline()[..200]).unwrap();
    let output = regress(&path, &[]);
    assert_eq!(output.status.code(), Some(3), "{}", complaint(&output));
    assert!(
        complaint(&output).contains("line") && complaint(&output).contains("column"),
        "{}",
        complaint(&output)
    );
    let output = regress(&folder.path().join("nowhere.json"), &[]);
    assert_eq!(output.status.code(), Some(5), "{}", complaint(&output));
    assert!(complaint(&output).contains("--update --reason"), "{}", complaint(&output));
}

#[test]
fn unchanged_runs_are_kept_once_and_counted() {
    let (folder, path) = changed(|_| ());
    let journal = folder.path().join("runs");
    let runs = |count: &str| {
        let mut command = hexbench();
        command.args(["validate", "regress", "--quick", "--runs", count, "--baseline"]).arg(&path);
        text(command.arg("--journal").arg(&journal).output().unwrap())
    };
    let shards = || {
        let entries = fs::read_dir(journal.join("journal")).unwrap().map(|entry| entry.unwrap().path());
        let shards = entries.filter(|path| path.extension().is_some_and(|end| end == "shard"));
        shards.map(|path| (path.clone(), fs::read(path).unwrap())).collect::<BTreeMap<_, _>>()
    };
    assert!(runs("1").contains("0 of 1 unchanged runs fail"));
    let first = shards();
    assert!(runs("2").contains(" of 2 unchanged runs fail"));
    let both = shards();
    let same = first.iter().filter(|(path, bytes)| both.get(*path) == Some(bytes)).count();
    // The last one may have had fewer trials.
    assert!(same + 1 >= first.len() && both.len() > first.len(), "{same} {} {}", first.len(), both.len());
}
