//! `diagnosis.json` is a contract: keys may be added, not removed.

use serde_json::Value;

use crate::support::{cases, diagnose, hexbench, hexbench_in, text};

const TOP: [&str; 23] = [
    "format",
    "verdict",
    "added",
    "small",
    "candidates",
    "credible_set",
    "steps",
    "nested",
    "noise",
    "parameters",
    "untestable",
    "detectable",
    "next",
    "separation",
    "absorbed",
    "suspects",
    "outside",
    "law",
    "findings",
    "excluded",
    "keep_all",
    "alternative",
    "run",
];

/// The diagnosis of a bundled case.
pub(crate) fn diagnosis(case: &str) -> Value {
    serde_json::from_str(&text(diagnose(case, &["--json", "-"]))).unwrap()
}

fn assert_keys(value: &Value, keys: &[&str], what: &str) {
    for key in keys {
        assert!(value.get(key).is_some(), "{what} lacks {key}: {value}");
    }
}

fn assert_error(error: &Value, what: &str) {
    assert_keys(error, &["chi2_reduced", "rms"], what);
    assert_keys(&error["rms"], &["translation_um", "rotation_urad"], what);
}

fn assert_items(diagnosis: &Value, list: &str, keys: &[&str]) {
    for item in diagnosis[list].as_array().unwrap() {
        assert_keys(item, keys, list);
    }
}

#[test]
fn every_key_of_the_contract_is_there() {
    for case in cases() {
        let d = diagnosis(&case);
        assert_keys(&d, &TOP, &case);
        assert_eq!(d["format"], "diagnosis/1");
        assert_items(&d, "candidates", &["term", "probability", "indistinguishable"]);
        assert_items(&d, "parameters", &["name", "value", "std", "unit"]);
        assert_items(&d, "untestable", &["term", "why"]);
        assert_items(&d, "detectable", &["term", "parameter", "unit", "size_at_90_percent_power"]);
        assert_items(&d, "next", &["pose", "wrench", "separates", "gain", "repeats", "delta_T_K", "text"]);
        assert_items(&d, "separation", &["between", "log10_bayes_factor", "right", "readings_needed"]);
        assert_items(&d, "absorbed", &["term", "bias_of_leg_stiffness_percent"]);
        assert_items(&d, "suspects", &["row", "z"]);
        let origin = [
            "program",
            "machine",
            "measurand",
            "hexapod_sha256",
            "data_sha256",
            "holdout_sha256",
            "drawn_from",
        ];
        assert_keys(&d["run"], &origin, "run");
        assert_keys(&d["noise"], &["translation_um", "rotation_urad", "source"], "noise");
        for step in d["steps"].as_array().unwrap() {
            assert_keys(step, &["terms", "chance", "gain", "worth"], "step");
            assert_error(step, "step");
            assert_error(&step["holdout"], "holdout");
        }
    }
}

#[test]
fn probabilities_of_the_first_addition_sum_to_one() {
    for case in cases() {
        let d = diagnosis(&case);
        let all = d["candidates"].as_array().unwrap();
        let sum: f64 = all.iter().map(|c| c["probability"].as_f64().unwrap()).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{case}: {sum}");
    }
}

#[test]
fn a_pattern_outside_the_catalogue_is_described() {
    let outside = diagnosis("not-in-catalogue")["outside"].clone();
    assert_keys(&outside, &["leg", "variable", "pattern", "period", "text"], "outside");
    assert_eq!(outside["pattern"], "periodic");
    let period_mm = outside["period"].as_f64().unwrap();
    assert!((period_mm - 8.0).abs() < 0.05, "{period_mm} mm");
}

#[test]
fn a_fit_is_written_with_its_quality_and_every_number() {
    let files = ["fit", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    let more = ["--add", "base-compliance", "--json", "-"];
    let output = hexbench_in("mujoco-foundation").args(files).args(more).output().unwrap();
    let told: Value = serde_json::from_str(&text(output)).unwrap();
    assert_eq!((&told["format"], &told["terms"][0]), (&"fit/1".into(), &"base-compliance".into()));
    let quality = |key: &str| told["quality"][key].as_f64().unwrap();
    assert!((quality("equations") - 6.0 * quality("readings")).abs() < 0.5, "{told}");
    let taken = quality("equations") - quality("dof");
    assert!((taken - quality("effective_parameters")).abs() < 1e-9, "{told}");
    assert!(told["parameters"].as_array().unwrap().iter().all(|p| p["std"].as_f64() > Some(0.0)), "{told}");
    assert_keys(&told, &["settled", "noise", "not_determined", "fitted", "held_out", "run"], "fit.json");
}

#[test]
fn the_catalogue_is_written_with_every_term_once() {
    let output = hexbench().args(["terms", "--json", "-"]).output().unwrap();
    let told: Value = serde_json::from_str(&text(output)).unwrap();
    assert_eq!(told["format"], "terms/1");
    let terms = told["terms"].as_array().unwrap();
    let mut ids: Vec<&str> = terms.iter().map(|term| term["id"].as_str().unwrap()).collect();
    let all = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert!(ids.len() == all && ids.contains(&"base-compliance"), "{ids:?}");
}
