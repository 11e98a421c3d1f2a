//! Bundled cases, answered from their public files.

use std::fs;
use std::path::Path;

use hexbench_core::files::read_measurements;
use tempfile::TempDir;

use super::{Answer, hexbench, paper};
use crate::inference::verdict::Verdict;
use crate::results::answer::{CaseFiles, Method, answer};

/// Reduced chi-square of held-out readings at the noise: 1, three standard deviations of 180 numbers, give or take.
const AT_THE_NOISE: f64 = 1.35;
/// Share of held-out numbers within 1.96 standard deviations of prediction and reading; 95 % less four of its own.
const LEAST_WITHIN: f64 = 0.88;

/// A bundled case as an entrant gets it; its held-out readings.
fn case(name: &str) -> (TempDir, Vec<[f64; 6]>) {
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases").join(name);
    let folder = tempfile::tempdir().unwrap();
    let files = [
        ("hexapod.toml", "hexapod.toml"),
        ("measurements.csv", "measurements.csv"),
        ("holdout.csv", "predict.csv"),
    ];
    for (from, to) in files {
        fs::copy(bundled.join(from), folder.path().join(to)).unwrap();
    }
    let held_out = read_measurements(&bundled.join("holdout.csv")).unwrap().dataset.observations;
    (folder, held_out.iter().map(|o| o.measured).collect())
}

/// Mean square of prediction minus reading in noise, and the share within 1.96 standard deviations.
fn judged(answer: &Answer, readings: &[[f64; 6]], noise: [f64; 6]) -> (f64, f64) {
    let mut squares = Vec::new();
    let mut within = 0;
    for (p, reading) in answer.predictions.iter().zip(readings) {
        for k in 0..6 {
            let error = p.value[k] - reading[k];
            squares.push((error / noise[k]).powi(2));
            within += usize::from(error.abs() <= 1.96 * p.sigma[k].hypot(noise[k]));
        }
    }
    let count = squares.len() as f64;
    (squares.iter().sum::<f64>() / count, within as f64 / count)
}

const NOISE: [f64; 6] = [0.5e-6, 0.5e-6, 0.5e-6, 3e-6, 3e-6, 3e-6];

#[test]
fn with_the_effect_named_predictions_are_at_the_noise_and_the_papers_are_not() {
    let (folder, readings) = case("mujoco-foundation");
    let case = CaseFiles::read(folder.path()).unwrap();
    let [ours, theirs] = [hexbench(&case).unwrap(), paper(&case).unwrap()];
    let [(own, within), (other, _)] = [&ours, &theirs].map(|a| judged(a, &readings, NOISE));
    assert!(own < AT_THE_NOISE && other > 2.0 * own, "{own}, the paper's {other}");
    assert!(within > LEAST_WITHIN, "{within}");
    assert_eq!(ours.diagnosis.unwrap().verdict, Verdict::Named);
}

#[test]
fn what_a_model_is_known_to_miss_is_in_its_uncertainty() {
    let (folder, readings) = case("not-in-catalogue");
    let found = hexbench(&CaseFiles::read(folder.path()).unwrap()).unwrap();
    let (chi2, within) = judged(&found, &readings, NOISE);
    assert_eq!(found.diagnosis.unwrap().verdict, Verdict::Outside);
    assert!(chi2 > AT_THE_NOISE && within > LEAST_WITHIN, "{chi2} {within}");
}

#[test]
fn the_papers_method_says_that_it_does_not_cover_poses() {
    let (folder, _) = case("absolute-pitch");
    let out = tempfile::tempdir().unwrap();
    let refused = answer(folder.path(), out.path(), Method::Paper).unwrap_err().to_string();
    assert!(refused.contains("absolute poses"), "{refused}");
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
}
