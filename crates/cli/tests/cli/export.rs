//! `hexbench export`: models for MuJoCo.

use std::fs;
use std::process::Output;

use crate::support::{complaint, hexbench, root, text};

fn export(scene: &str, more: &[&str]) -> Output {
    hexbench().arg("export").arg(root().join(scene)).arg("--mjcf").args(more).output().unwrap()
}

#[test]
fn a_row_chooses_pose_and_load_and_a_pose_replaces_only_the_pose() {
    let [first, third] = ["1", "3"].map(|row| text(export("data/witness/legs-alone", &["--row", row])));
    let posed = text(export("data/witness/legs-alone", &["--row", "3", "--pose", "1.5,0,-2,0,0.5,0"]));
    let load = |model: &str| model.split("ctrl=").nth(1).unwrap().split('"').nth(1).unwrap().to_owned();
    assert_ne!(load(&first), load(&third));
    assert_eq!(load(&posed), load(&third));
    assert!(posed.contains("pos=\"0.0015 0 -0.002\""), "{posed}");
}

#[test]
fn states_are_models_with_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/states");
    text(export("data/witness/everything", &["--states", "5", "-o", out.to_str().unwrap()]));
    let table = fs::read_to_string(out.join("states.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 6, "{table}");
    let cells = |line: &str| line.split(',').count();
    assert!(lines.iter().all(|line| cells(line) == cells(lines[0])), "{table}");
    for k in 1..=5 {
        let model = fs::read_to_string(out.join(format!("state-00{k}.xml"))).unwrap();
        assert!(model.starts_with("<mujoco ") && model.ends_with("</mujoco>\n"));
    }
}

#[test]
fn what_the_format_lacks_is_bad_input_and_named() {
    let output = export("scenes/cubic", &[]);
    assert_eq!(output.status.code(), Some(3));
    let told = complaint(&output);
    assert!(told.contains("MJCF cannot express a leg that is softer under tension"), "{told}");
    assert!(output.stdout.is_empty());
}

#[test]
fn wrong_usage_is_told_with_the_next_step() {
    for (more, expected) in [
        (vec!["--row", "0"], "0"),
        (vec!["--row", "100000"], "Use a row from 1 to"),
        (
            vec!["--pose", "1,2,3"],
            "3 numbers; six with commas between are needed, for example 0,0,10,0,2.5,0 (mm, deg)",
        ),
        (vec!["--states", "5"], "Name one with -o DIR"),
        (vec!["--states", "5", "--row", "2"], "cannot be used with"),
    ] {
        let output = export("data/witness/legs-alone", &more);
        let told = complaint(&output);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {told}");
        assert!(told.contains(expected), "{more:?}: {told}");
    }
}
