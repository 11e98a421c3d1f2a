//! Absolute poses in a frame of somebody else's choice, as a user has them in a file.

use std::process::Output;

use crate::support::{complaint, hexbench, root};

/// Columns of the measured pose in the bundled file.
const MEASURED: usize = 16;
/// Relative difference that rounding of files and the axes of the weights leave.
const SAME: f64 = 1e-4;

/// A file of the bundled case with every measured pose changed.
fn changed(file: &str, change: impl Fn(&mut [f64])) -> String {
    let text = std::fs::read_to_string(root().join("data/cases/absolute-pitch").join(file)).unwrap();
    let row = |line: &str| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let mut measured: Vec<f64> = cells[MEASURED..].iter().map(|c| c.parse().unwrap()).collect();
        change(&mut measured);
        cells.truncate(MEASURED);
        cells.extend(measured.iter().map(f64::to_string));
        cells.join(",")
    };
    let mut lines = text.lines();
    let header = lines.next().unwrap().to_owned();
    assert!(header.split(',').nth(MEASURED) == Some("measured_a_mm"), "{header}");
    std::iter::once(header).chain(lines.map(row)).fold(String::new(), |all, line| all + &line + "\n")
}

/// A quarter turn about the vertical, and an origin 3 m away.
fn elsewhere(x: &mut [f64]) {
    (x[0], x[1], x[2]) = (3000.0 - x[1], -2000.0 + x[0], x[2] + 500.0);
    x[5] += 90.0;
}

/// A command on the bundled machine with other readings.
fn on(command: &str, measurements: &str, holdout: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("measurements.csv"), measurements).unwrap();
    std::fs::write(folder.path().join("holdout.csv"), holdout).unwrap();
    let hexapod = root().join("data/cases/absolute-pitch/hexapod.toml");
    let files = ["measurements.csv", "--holdout", "holdout.csv"];
    hexbench().current_dir(folder.path()).arg(command).arg(hexapod).args(files).args(more).output().unwrap()
}

fn same(_: &mut [f64]) {}

#[test]
fn a_comparison_does_not_depend_on_where_the_measuring_machine_has_its_origin_and_axes() {
    let told = |change: fn(&mut [f64])| -> serde_json::Value {
        let [data, held] = ["measurements.csv", "holdout.csv"].map(|file| changed(file, change));
        let output = on("compare", &data, &held, &["--json", "-"]);
        assert!(output.status.success(), "{}", complaint(&output));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let [near, far] = [told(same), told(elsewhere)];
    for part in ["error", "holdout"] {
        let [a, b] = [&near, &far].map(|json| json[part]["chi2_reduced"].as_f64().unwrap());
        assert!((b / a - 1.0).abs() < SAME, "{part}: {a} {b}");
    }
}

#[test]
fn poses_that_do_not_follow_the_commands_are_an_error_with_the_next_step_and_no_verdict() {
    let [data, held] = ["measurements.csv", "holdout.csv"].map(|file| changed(file, same));
    let metres = changed("measurements.csv", |x| x[..3].iter_mut().for_each(|mm| *mm *= 1000.0));
    let moved = changed("holdout.csv", elsewhere);
    for (data, held, what) in
        [(&metres, &held, "measured-pose=positions*0.001"), (&data, &moved, "same frames")]
    {
        for command in ["compare", "fit", "diagnose"] {
            let output = on(command, data, held, &[]);
            let told = complaint(&output);
            assert_eq!(output.status.code(), Some(3), "{command}: {told}");
            assert!(
                told.contains("do not match the commanded ones") && told.contains(what),
                "{command}: {told}"
            );
            assert!(output.stdout.is_empty(), "{command}");
        }
    }
}
