//! Running the command; finding the bundled cases.

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;

/// Root of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The command, run in the folder of a case, without color from outside.
pub(crate) fn hexbench_in(case: &str) -> Command {
    let mut command = hexbench();
    command.current_dir(root().join("data/cases").join(case));
    command
}

/// The command.
pub(crate) fn hexbench() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hexbench"));
    command.env_remove("NO_COLOR");
    command
}

/// `diagnose hexapod.toml measurements.csv --holdout holdout.csv` and more, in the folder of a case.
pub(crate) fn diagnose(case: &str, more: &[&str]) -> Output {
    let files = ["diagnose", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    hexbench_in(case).args(files).args(more).output().unwrap()
}

/// Standard output as text; the command must have ended well.
pub(crate) fn text(output: Output) -> String {
    assert!(output.status.success(), "{}", complaint(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// What the command wrote to standard error.
pub(crate) fn complaint(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Names of the bundled cases.
pub(crate) fn cases() -> Vec<String> {
    let folders = std::fs::read_dir(root().join("data/cases")).unwrap().map(|f| f.unwrap());
    let mut names: Vec<String> = folders
        .filter(|f| f.path().join("truth.json").is_file())
        .map(|f| f.file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.len() >= 8, "the bundled cases are missing: {names:?}");
    names
}
