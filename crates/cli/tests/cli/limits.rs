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

/// A number with which nothing could fail, or nothing is asked.
#[test]
fn a_limit_that_nothing_exceeds_and_a_load_that_moves_nothing_are_refused() {
    let usage = |words: &[&str], says: &str| {
        let output = hexbench_in("mujoco-clean").args(words).output().unwrap();
        let said = complaint(&output);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains(says) && output.stdout.is_empty(), "{words:?}: {said}");
    };
    for limit in ["nan", "inf", "1e400", "0", "-1"] {
        usage(&["compare", "hexapod.toml", "measurements.csv", "--check", limit], "--check");
    }
    usage(
        &["power", "hexapod.toml", "measurements.csv", "--power", "0.005"],
        "a power of 0.005 is not above the false-alarm probability of 0.01",
    );
    let nothing = ["--load", "0,0,0,0,0,0", "--stiffness", "4"];
    usage(&[&["transient", "hexapod.toml"], &nothing[..]].concat(), "the load is zero");
}

/// A model that is at the noise where it was fitted, beside held-out readings that are half as large again.
#[test]
fn a_comparison_is_not_adequate_where_held_out_readings_are_far_off() {
    let folder = tempfile::tempdir().unwrap();
    let held = fs::read_to_string(root().join("data/cases/mujoco-clean/holdout.csv")).unwrap();
    let mut lines = held.lines();
    let header = lines.next().unwrap();
    let place = header.split(',').position(|name| name == "da_um").unwrap();
    let larger = |line: &str| {
        let cell = |(k, cell): (usize, &str)| {
            if k >= place { (1.5 * cell.parse::<f64>().unwrap()).to_string() } else { cell.to_owned() }
        };
        line.split(',').enumerate().map(cell).collect::<Vec<_>>().join(",")
    };
    let text_of_all: Vec<String> = std::iter::once(header.to_owned()).chain(lines.map(larger)).collect();
    let off = folder.path().join("holdout.csv");
    fs::write(&off, text_of_all.join("\n") + "\n").unwrap();
    let compared = |holdout: &str| {
        let words = ["compare", "hexapod.toml", "measurements.csv", "--holdout", holdout];
        text(hexbench_in("mujoco-clean").args(words).output().unwrap())
    };
    assert!(compared("holdout.csv").contains("noise alone"));
    let page = compared(off.to_str().unwrap()).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        page.contains("NOT ADEQUATE The error of this model is noise on the readings compared"),
        "{page}"
    );
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
