//! The bundled cases against their truth: right, honest or wrong.

use std::fs;

use serde_json::Value;

use crate::json::diagnosis;
use crate::support::{cases, root};

/// Cases that may be ambiguous: in the one, play whose contact is soft fits as well as the bent spring that is hidden, by 0.5 in
/// chi-square; in the other, the plan cannot tell.
const CANNOT_TELL: [&str; 2] = ["contact", "paper-protocol"];
/// Reduced chi-square on held-out poses that counts as noise, for 180 numbers at three standard deviations.
const AT_THE_NOISE: f64 = 1.35;
/// Standard uncertainties allowed between a fitted and a true value.
const SIGMAS: f64 = 4.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Score {
    Right,
    Honest,
    Wrong,
}

fn words(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect()
}

fn same(a: &[&str], b: &[&str]) -> bool {
    a.len() == b.len() && a.iter().all(|x| b.contains(x))
}

/// Exactly the truth is right; the truth within the credible set of an ambiguous answer is honest.
fn judge(truth: &Value, d: &Value) -> Score {
    let effects = words(&truth["effects"]);
    let (outside, named): (Vec<&str>, Vec<&str>) = effects.iter().partition(|e| e.starts_with("out:"));
    let (verdict, added, credible) = (&d["verdict"], words(&d["added"]), words(&d["credible_set"]));
    let right = match (outside.is_empty(), named.is_empty()) {
        (false, _) => verdict == "outside",
        (true, true) => verdict == "adequate" && added.is_empty(),
        (true, false) => verdict == "named" && same(&added, &named),
    };
    let known = |e: &&str| credible.contains(e) || added.contains(e);
    let honest = outside.is_empty() && !named.is_empty() && verdict == "ambiguous" && named.iter().all(known);
    match (right, honest) {
        (true, _) => Score::Right,
        (_, true) => Score::Honest,
        _ => Score::Wrong,
    }
}

fn truth(case: &str) -> Value {
    let text = fs::read_to_string(root().join("data/cases").join(case).join("truth.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn no_case_is_wrong_and_all_that_can_tell_are_right() {
    let score = |case: &String| judge(&truth(case), &diagnosis(case));
    let scores: Vec<(String, Score)> = cases().iter().map(|c| (c.clone(), score(c))).collect();
    let may_be =
        |case: &str, s: Score| s == Score::Right || s == Score::Honest && CANNOT_TELL.contains(&case);
    assert!(scores.iter().all(|(case, s)| may_be(case, *s)), "{scores:?}");
}

#[test]
fn with_the_named_effects_the_held_out_error_is_at_the_noise() {
    for case in cases() {
        let d = diagnosis(&case);
        if d["verdict"] == "named" {
            let last = d["steps"].as_array().unwrap().last().unwrap();
            let chi2 = last["holdout"]["chi2_reduced"].as_f64().unwrap();
            assert!(chi2 < AT_THE_NOISE, "{case}: held-out chi-square {chi2}");
        }
    }
}

#[test]
fn leg_stiffnesses_are_true_within_their_uncertainty() {
    for case in cases() {
        let (truth, d) = (truth(&case), diagnosis(&case));
        if judge(&truth, &d) == Score::Right && d["verdict"] != "outside" {
            for leg in 0..6 {
                let z = stiffness_error(&truth, &d, leg);
                assert!(z < SIGMAS, "{case}: leg {} is {z} sigma off", leg + 1);
            }
        }
    }
}

fn stiffness_error(truth: &Value, d: &Value, leg: usize) -> f64 {
    let name = format!("leg-{}.stiffness", leg + 1);
    let fitted = d["parameters"].as_array().unwrap().iter().find(|p| p["name"] == name.as_str()).unwrap();
    let number = |v: &Value| v.as_f64().unwrap();
    let true_stiffness = number(&truth["leg_stiffness_N_per_um"][leg]);
    (number(&fitted["value"]) - true_stiffness).abs() / number(&fitted["std"])
}

#[test]
fn the_plan_that_cannot_tell_says_so_and_proposes_a_reading_that_can() {
    let d = diagnosis("paper-protocol");
    assert_eq!(d["verdict"], "ambiguous");
    assert!(words(&d["credible_set"]).contains(&"base-compliance"));
    let next = d["next"].as_array().unwrap();
    assert!(!next.is_empty());
    assert!(next[0]["gain"].as_f64().unwrap() > 1.0, "{next:?}");
}

#[test]
fn the_pitch_of_the_screws_is_determined_and_true() {
    const TRUE_PITCH_MM: f64 = 3.0;
    let d = diagnosis("absolute-pitch");
    let pitch =
        d["parameters"].as_array().unwrap().iter().find(|p| p["name"] == "actuator-pitch.pitch").unwrap();
    let (value, std) = (pitch["value"].as_f64().unwrap(), pitch["std"].as_f64().unwrap());
    assert!(std < 0.01 && (value - TRUE_PITCH_MM).abs() < SIGMAS * std, "{value} +- {std} mm");
}
