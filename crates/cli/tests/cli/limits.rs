//! Tables and computations that are larger than they may be are refused before any work.

use std::fs;

use serde_json::Value;

use crate::support::{complaint, hexbench, hexbench_in, root, text};

fn refused(words: &[&str], code: i32, says: &str) {
    let files = ["hexapod.toml", "measurements.csv"];
    let output =
        hexbench_in("mujoco-clean").args(&words[..1]).args(files).args(&words[1..]).output().unwrap();
    let said = complaint(&output);
    assert_eq!(output.status.code(), Some(code), "{words:?}: {said}");
    assert!(said.contains(says) && said.contains("next: "), "{words:?}: {said}");
    assert!(output.stdout.is_empty(), "refused before any work");
}

#[test]
fn a_table_of_more_rows_than_are_wanted_is_refused_at_the_first_of_them() {
    for command in ["fit", "compare", "diagnose", "discover", "check"] {
        let says = "measurements.csv: line 102: the table has more than 100 rows";
        refused(&[command, "--max-rows", "100"], 3, says);
    }
}

#[test]
fn a_computation_that_needs_more_memory_than_there_is_is_refused_with_both_sizes() {
    for (command, what) in [
        ("fit", "a fit of 168 readings under 84 conditions needs about 22 MB, but only 10 MB are free"),
        ("compare", "a comparison of 168 readings"),
        ("diagnose", "a diagnosis of 168 readings under 84 conditions needs about 24 MB"),
        ("discover", "a diagnosis of 168 readings"),
    ] {
        refused(&[command, "--max-memory", "0.01"], 5, what);
    }
}

#[test]
fn what_fits_is_computed() {
    let words = ["fit", "hexapod.toml", "measurements.csv", "--max-rows", "168", "--max-memory", "0.1"];
    assert!(hexbench_in("mujoco-clean").args(words).output().unwrap().status.success());
}

/// Of a table of 1200 readings at 100 poses.
#[test]
fn of_a_long_table_whole_poses_are_drawn_and_every_output_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let run = |words: &[&str]| hexbench().current_dir(&folder).args(words).output().unwrap();
    let scene = root().join("scenes/hidden-1");
    text(run(&["simulate", scene.to_str().unwrap(), "--poses", "100", "-o", "campaign"]));
    let asked = |command: &str, more: &[&str]| {
        let files = [command, "campaign/hexapod.toml", "campaign/measurements.csv"];
        run(&[&files, more].concat())
    };
    let json = |name: &str| -> Value {
        serde_json::from_str(&fs::read_to_string(folder.path().join(name)).unwrap()).unwrap()
    };

    let drawn = asked("diagnose", &["--most-readings", "1000", "--exclude", "2-13", "--json", "d.json"]);
    let said = complaint(&drawn);
    assert!(said.contains("of 1200 readings are used, drawn at random by poses"), "{said}");
    assert!(said.contains("`--most-readings 1200` uses all of them"), "{said}");
    let page = text(drawn);
    assert!(page.contains("of 1200 deflections, at 8") && page.contains("poses drawn at random"), "{page}");
    let d = json("d.json");
    assert_eq!(d["run"]["drawn_from"], 1200);
    crate::schemas::check("diagnosis/1", std::slice::from_ref(&d));
    assert_eq!(d["excluded"].as_array().unwrap().len(), 12, "lines that are named were drawn or not");

    let table = asked("compare", &["--table", "t.csv", "--json", "c.json"]);
    assert!(complaint(&table).is_empty(), "1200 readings are no long table: {}", complaint(&table));
    assert_eq!(json("c.json")["run"]["drawn_from"], Value::Null);
    let of_all = text(asked("compare", &["--table", "t.csv", "--most-readings", "1000"]));
    assert!(of_all.contains("of 1200 deflections"), "{of_all}");
    let rows = fs::read_to_string(folder.path().join("t.csv")).unwrap().lines().count();
    assert!(rows < 1001, "{rows}");

    assert_eq!(
        asked("discover", &["--most-readings", "999"]).status.code(),
        Some(2),
        "too few to say anything"
    );
}
