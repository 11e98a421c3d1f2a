//! The registry is complete and well formed.

use std::{collections::BTreeSet, fs, path::Path};

use hexbench_truth::{
    TruthError,
    mechanisms::{REGISTRY, Shows, build},
};

#[test]
fn ids_are_unique_and_kebab_case() {
    let ids: BTreeSet<&str> = REGISTRY.iter().map(|e| e.id).collect();
    assert_eq!(ids.len(), REGISTRY.len());
    for id in ids {
        let plain = id.strip_prefix("out:").unwrap_or(id);
        assert!(plain.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{id}");
        assert!(!plain.starts_with('-') && !plain.ends_with('-'), "{id}");
    }
}

#[test]
fn what_is_outside_the_catalogue_says_so_and_comes_last() {
    assert!(REGISTRY.iter().all(|e| e.id.starts_with("out:") == (e.shows == Shows::Outside)));
    assert!(REGISTRY.is_sorted_by_key(|e| e.shows == Shows::Outside));
}

#[test]
fn every_file_is_registered_under_its_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/mechanisms");
    let files: BTreeSet<String> = fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|stem| stem != "mod")
        .collect();
    let ids: BTreeSet<String> =
        REGISTRY.iter().map(|e| e.id.trim_start_matches("out:").replace('-', "_")).collect();
    assert_eq!(files, ids);
}

#[test]
fn a_mechanism_is_built_from_its_parameters() {
    let gap = build("leg-backlash", serde_json::json!({ "gap": 2e-6 })).unwrap();
    assert_eq!(gap.id(), "leg-backlash");
    let wrong = build("leg-backlash", serde_json::json!({ "gap": 2e-6, "play": 1.0 }));
    assert!(matches!(wrong, Err(TruthError::BadParameters { .. })));
    let unknown = build("leg-magic", serde_json::json!({}));
    assert!(matches!(unknown, Err(TruthError::UnknownMechanism { .. })));
}
