//! Tables and computations that are larger than they may be are refused before any work.

use crate::support::{complaint, hexbench_in};

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
