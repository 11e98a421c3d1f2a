//! Files that a hand has changed: models, terms and loads that cannot be.

use std::fs;
use std::path::Path;
use std::process::Output;

use tempfile::TempDir;

use crate::support::{complaint, hexbench, root};

/// A folder with a case and a model fitted to it.
fn fitted() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["hexapod.toml", "measurements.csv"] {
        fs::copy(root().join("data/cases/mujoco-clean").join(name), folder.path().join(name)).unwrap();
    }
    let output = run(&folder, &["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"]);
    assert!(output.status.success(), "{}", complaint(&output));
    folder
}

fn run(folder: &TempDir, words: &[&str]) -> Output {
    hexbench().current_dir(folder.path()).args(words).output().unwrap()
}

fn change(path: &Path, line: &str, new: &str) {
    let text = fs::read_to_string(path).unwrap();
    let old = text.lines().find(|l| l.starts_with(line)).unwrap();
    fs::write(path, text.replacen(old, new, 1)).unwrap();
}

#[test]
fn a_model_that_was_changed_is_refused_unless_it_is_trusted() {
    let folder = fitted();
    change(&folder.path().join("model.toml"), "name", "name = \"another machine\"");
    for words in [
        &["predict", "model.toml", "measurements.csv"][..],
        &["compensate", "model.toml", "measurements.csv"],
        &["compare", "hexapod.toml", "measurements.csv", "--model", "model.toml"],
    ] {
        let output = run(&folder, words);
        assert_eq!(output.status.code(), Some(3), "{words:?}: {}", complaint(&output));
        assert!(
            complaint(&output).contains("changed after `fit` wrote it")
                && complaint(&output).contains("--trust")
        );
        let trusted = run(&folder, &[words, &["--trust"]].concat());
        assert!(trusted.status.success(), "{words:?}: {}", complaint(&trusted));
    }
}

#[test]
fn a_spring_that_cannot_be_is_refused_with_its_leg_also_when_trusted() {
    let folder = fitted();
    change(&folder.path().join("model.toml"), "compliance_si", "compliance_si = 0.0");
    let output = run(&folder, &["predict", "model.toml", "measurements.csv", "--trust"]);
    assert_eq!(output.status.code(), Some(3), "{}", complaint(&output));
    assert!(complaint(&output).contains("model.toml: leg 1: the compliance 0 m/N must be greater than zero"));
    assert!(output.stdout.is_empty());
}

#[test]
fn a_model_or_term_that_is_no_text_is_bad_input_with_its_line() {
    let folder = fitted();
    fs::write(folder.path().join("bad.toml"), b"format = \"model/1\"\nprogram = \"\xff\"\n").unwrap();
    for words in [
        &["predict", "bad.toml", "measurements.csv"][..],
        &["compare", "hexapod.toml", "measurements.csv", "--model", "bad.toml"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--term", "bad.toml"],
    ] {
        let output = run(&folder, words);
        assert_eq!(output.status.code(), Some(3), "{words:?}: {}", complaint(&output));
        assert!(
            complaint(&output).contains("line 2") && complaint(&output).contains("UTF-8"),
            "{}",
            complaint(&output)
        );
    }
    let absent = run(&folder, &["predict", "absent.toml", "measurements.csv"]);
    assert_eq!(absent.status.code(), Some(5), "{}", complaint(&absent));
}

/// Whatever their size, loads of a scene end in a world or in a reason.
#[test]
fn absurd_loads_are_bad_input_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, source] = [folder.path().join("scene"), root().join("scenes/hidden-1")];
    fs::create_dir_all(scene.join("sealed")).unwrap();
    for name in ["hexapod.toml", "scene.toml", "sealed/truth.toml"] {
        fs::copy(source.join(name), scene.join(name)).unwrap();
    }
    let text = fs::read_to_string(source.join("scene.toml")).unwrap();
    let first = text.lines().position(|line| line.starts_with("loads_N_Nm")).unwrap() + 1;
    let old = text.lines().nth(first).unwrap();
    for load in ["1e308", "-1e308", "9e29", "1e25", "-1e25"] {
        let changed = text.replacen(old, &format!("  [0, 0, {load}, 0, 0, 0],"), 1);
        fs::write(scene.join("scene.toml"), changed).unwrap();
        let output = run(&folder, &["simulate", "scene", "-o", "out"]);
        assert_eq!(output.status.code(), Some(3), "{load}: {}", complaint(&output));
        assert!(complaint(&output).contains("next: "), "{load}: {}", complaint(&output));
    }
}
