//! Exit codes: 0 done, 1 check failed, 2 usage, 3 bad input, 4 not determined, 5 input or output.

use std::fs;

use crate::support::{complaint, diagnose, hexbench, hexbench_in};

/// Exit code and standard error of `diagnose` with the machine of a case and other measurements.
fn with_measurements(csv: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("measurements.csv");
    fs::write(&data, csv).unwrap();
    let output = hexbench_in("mujoco-clean").args(["diagnose", "hexapod.toml"]).arg(&data).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

const HEADER: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
                      da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad\n";

#[test]
fn a_diagnosis_is_done() {
    assert_eq!(diagnose("mujoco-clean", &[]).status.code(), Some(0));
}

#[test]
fn a_check_that_holds_is_done_and_one_that_fails_exits_with_1() {
    assert_eq!(diagnose("mujoco-clean", &["--check"]).status.code(), Some(0));
    assert_eq!(diagnose("mujoco-foundation", &["--check=named"]).status.code(), Some(0));
    let failed = diagnose("mujoco-foundation", &["--check"]);
    assert_eq!(failed.status.code(), Some(1));
    assert!(complaint(&failed).contains("the verdict is named, not adequate"));
    assert!(!failed.stdout.is_empty(), "the page is printed before the check");
}

#[test]
fn wrong_usage_exits_with_2() {
    hexbench().arg("diagnos").assert().code(2);
    hexbench().args(["diagnose", "only-one-file"]).assert().code(2);
    let output = hexbench().args(["terms", "base-complience"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(complaint(&output).contains("did you mean `base-compliance`?"));
}

#[test]
fn bad_input_exits_with_3_and_names_file_line_column_and_next_step() {
    let row = "1,1,0,0,0,0,0,0,0,0,-100,0,0,0,1,2,oops,4,5,6\n";
    let (code, stderr) = with_measurements(&format!("{HEADER}{row}"));
    assert_eq!(code, Some(3), "{stderr}");
    for part in ["measurements.csv", "line 2", "column 17", "dc_um", "oops", "next: "] {
        assert!(stderr.contains(part), "{part} is missing in {stderr}");
    }
}

#[test]
fn files_in_the_wrong_order_are_said_as_such() {
    for (files, what) in [
        (
            ["measurements.csv", "hexapod.toml"],
            "measurements.csv: this is a table, not a file of the format hexapod/1",
        ),
        (["hexapod.toml", "hexapod.toml"], "hexapod.toml: this is a TOML file, not a table"),
    ] {
        let output = hexbench_in("mujoco-clean").arg("diagnose").args(files).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{stderr}");
        assert!(stderr.contains(what), "{stderr}");
        assert!(stderr.contains("hexapod.toml comes first, then its measurements.csv"), "{stderr}");
    }
    let output =
        hexbench_in("mujoco-clean").args(["simulate", "hexapod.toml", "-o", "none"]).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(5), "{stderr}");
    assert!(stderr.contains("a scene, for example, is the folder that contains scene.toml"), "{stderr}");
}

#[test]
fn too_little_data_exits_with_4() {
    let row = "1,1,0,0,0,0,0,0,0,0,0,0,0,0,1,2,3,4,5,6\n";
    let (code, stderr) = with_measurements(&format!("{HEADER}{row}"));
    assert_eq!(code, Some(4), "{stderr}");
    assert!(stderr.contains("next: "), "{stderr}");
}

#[test]
fn a_missing_file_exits_with_5() {
    let output =
        hexbench_in("mujoco-clean").args(["diagnose", "hexapod.toml", "absent.csv"]).output().unwrap();
    assert_eq!(output.status.code(), Some(5));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("absent.csv") && stderr.contains("next: "), "{stderr}");
}

#[test]
fn a_folder_that_cannot_be_written_to_exits_with_5() {
    let output = diagnose("mujoco-clean", &["--json", "no/such/folder/d.json"]);
    assert_eq!(output.status.code(), Some(5));
}

#[test]
fn a_transient_without_stiffness_or_with_a_short_load_is_wrong_usage() {
    let bare =
        hexbench_in("mujoco-clean").args(["transient", "hexapod.toml", "--load", "0,0,-9,0,0,0"]).output();
    let bare = bare.unwrap();
    assert_eq!(bare.status.code(), Some(2));
    let stderr = complaint(&bare);
    assert!(stderr.contains("nominal_stiffness") && stderr.contains("--stiffness"), "{stderr}");
    let short = hexbench_in("mujoco-clean").args(["transient", "hexapod.toml", "--load", "0,0,-9"]).output();
    let stderr = String::from_utf8_lossy(&short.unwrap().stderr).into_owned();
    assert!(stderr.contains("3 numbers; six"), "{stderr}");
}
