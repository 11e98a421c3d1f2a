//! `hexbench validate recovery`, one campaign of each subject.

use hexbench_model::terms::catalogue;
use serde_json::Value;

use crate::support::{hexbench, text};

/// Seed of a study whose few campaigns hold their bounds.
const SEED: &str = "5";

#[test]
fn recovery_prints_pages_of_80_columns_and_writes_its_figures_and_its_document() {
    let folder = tempfile::tempdir().unwrap();
    let (json, markdown) = (folder.path().join("recovery.json"), folder.path().join("recovery.md"));
    let mut command = hexbench();
    command.args(["validate", "recovery", "--campaigns", "1", "--diagnoses", "0", "--check", "--seed", SEED]);
    command.arg("--json").arg(&json).arg("--markdown").arg(&markdown);
    let page = text(command.output().unwrap());
    let widest = page.lines().map(|l| l.chars().count()).max().unwrap();
    assert!(widest <= 80, "{widest} columns");
    assert!(page.contains("base-compliance") && page.contains("bounds hold"), "{page}");
    let figures: Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(figures["format"], "recovery/1");
    // Springs alone, of deflections and of absolute poses, and a whole machine beside every effect.
    assert_eq!(figures["rows"].as_array().unwrap().len(), 3 + catalogue().len());
    let document = std::fs::read_to_string(markdown).unwrap();
    assert!(document.contains("| base-compliance ") && document.contains("`base`"), "{document}");
}

#[test]
fn no_campaigns_are_wrong_usage() {
    hexbench().args(["validate", "recovery", "--campaigns", "0"]).assert().code(2);
}
