//! Documents that state what the code is: generated, or checked against it.

use std::fs;

use cargo_metadata::MetadataCommand;

use crate::support::{hexbench, root, text};

/// Set to write generated documents instead of comparing them.
const BLESS: &str = "HEXBENCH_BLESS";

#[test]
fn the_page_of_effects_is_what_the_code_says() {
    let path = root().join("docs/effects.md");
    let fresh = text(hexbench().args(["terms", "--markdown"]).output().unwrap());
    if std::env::var_os(BLESS).is_some() {
        fs::write(&path, &fresh).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == fresh, "docs/effects.md is stale: run the tests once with {BLESS}=1");
}

#[test]
fn the_architecture_names_every_crate_and_no_other() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let metadata = MetadataCommand::new().current_dir(root()).no_deps().exec().unwrap();
    let members: Vec<String> = metadata.workspace_packages().iter().map(|p| p.name.to_string()).collect();
    for name in &members {
        assert!(page.contains(&format!("`{name}`")), "ARCHITECTURE.md does not name {name}");
    }
    for name in page.split('`').filter(|w| w.starts_with("hexbench-")) {
        assert!(members.iter().any(|m| m == name), "ARCHITECTURE.md names {name}, which is gone");
    }
}

#[test]
fn every_path_in_the_architecture_exists() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let paths: Vec<&str> = page.split('`').filter(|w| w.contains('/') && !w.contains([' ', '*'])).collect();
    assert!(paths.len() > 10, "{paths:?}");
    for path in paths {
        assert!(root().join(path).exists(), "ARCHITECTURE.md names {path}, which is gone");
    }
}

#[test]
fn the_readme_shows_the_errors_of_the_demo() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let demo = text(hexbench().args(["demo", "--no-report"]).output().unwrap());
    let steps = demo.lines().filter(|l| l.trim_end().ends_with('#'));
    let rungs: Vec<&str> = steps
        .filter(|l| ["springs alone", "+ ", "noise of one"].iter().any(|s| l.trim().starts_with(s)))
        .collect();
    assert_eq!(rungs.len(), 3, "{rungs:?}");
    for rung in rungs {
        assert!(readme.contains(rung.trim_end()), "README.md lacks the line: {rung}");
    }
}
