//! `diagnosis.json`: the part of `diagnosis/1` that is judged.

use std::collections::BTreeSet;

use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use serde::Deserialize;

use super::AnswerFault;
use super::fault::place_of_key;
use crate::challenge::folder::DIAGNOSIS;

const FORMAT: &str = "diagnosis/1";
/// Digits may be rounded, sums too: so far may probabilities be beside 1.
const ROUNDING: f64 = 1e-3;

/// What is said about a case; other keys of the file are passed over.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct StatedDiagnosis {
    format: String,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named.
    #[serde(default)]
    pub added: Vec<String>,
    /// Effects not excluded.
    #[serde(default)]
    pub credible_set: Vec<Explanation>,
    /// Probabilities of the first addition; empty when none are stated, else they sum to 1.
    #[serde(default)]
    pub candidates: Vec<StatedCandidate>,
}

/// An explanation and its probability.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct StatedCandidate {
    /// What it is.
    pub term: Explanation,
    /// Its probability.
    pub probability: f64,
}

/// What is said, or everything that is wrong with it.
pub(super) fn read(text: &str) -> Result<StatedDiagnosis, Vec<AnswerFault>> {
    let mut said: StatedDiagnosis =
        serde_json::from_str(text).map_err(|e| vec![AnswerFault::json(DIAGNOSIS, &e)])?;
    let mut faults = Vec::new();
    let mut fault = |key: &str, k: usize, place: &str, rule: &str, next: &str| {
        let place = format!("{}{place}", place_of_key(text, key, k));
        faults.push(AnswerFault::new(DIAGNOSIS, &place, rule).then(next));
    };
    if said.format != FORMAT {
        let rule = format!("\"{}\": the format must be \"{FORMAT}\"", said.format);
        fault("format", 0, "format", &rule, "Write \"format\": \"diagnosis/1\".");
    }
    let mut names = BTreeSet::new();
    for (k, candidate) in said.candidates.iter().enumerate() {
        let place = format!("candidates[{k}] ({})", candidate.term);
        if !names.insert(candidate.term.word()) {
            fault(
                "term",
                k,
                &place,
                "this candidate is given twice",
                "Keep one of them, with the sum of both.",
            );
        }
        if !(0.0..=1.0 + ROUNDING).contains(&candidate.probability) {
            let rule = format!("{}: a probability is between 0 and 1", candidate.probability);
            fault("term", k, &place, &rule, "Write a share, not percent.");
        }
    }
    let sum: f64 = said.candidates.iter().map(|c| c.probability).sum();
    if !said.candidates.is_empty() && (sum - 1.0).abs() > ROUNDING {
        let rule =
            format!("the probabilities sum to {sum}, not to 1; \"outside\" and \"none\" belong to them");
        fault(
            "candidates",
            0,
            "candidates",
            &rule,
            "Divide each by their sum, or give what is left to \"outside\" and \"none\".",
        );
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    said.candidates.iter_mut().for_each(|c| c.probability /= sum);
    Ok(said)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_keys_are_passed_over_and_probabilities_are_made_to_sum_to_one() {
        let text = r#"{"format": "diagnosis/1", "verdict": "ambiguous", "credible_set": ["creep"], "noise": {},
            "candidates": [{"term": "creep", "probability": 0.6, "indistinguishable": []}, {"term": "none", "probability": 0.3996}]}"#;
        let said = read(text).unwrap();
        let sum: f64 = said.candidates.iter().map(|c| c.probability).sum();
        assert!((sum - 1.0).abs() < 1e-12 && said.verdict == Verdict::Ambiguous, "{sum}");
    }

    #[test]
    fn every_fault_has_its_place() {
        let file = |rest: &str| format!("{{\"format\": \"diagnosis/1\", \"verdict\": \"named\"{rest}}}");
        let candidates = |list: &str| file(&format!(", \"candidates\": [{list}]"));
        for (text, expected) in [
            ("[]", "line 1"),
            ("{\"format\": \"diagnosis/1\"}", "the key `verdict` is missing"),
            (
                "{\"format\": \"diagnosis/1\", \"verdict\": \"sure\"}",
                "`sure` is not a possible value; possible: ",
            ),
            ("{\"format\": \"d\", \"verdict\": \"named\"}", "the format must be"),
            (&candidates("{\"term\": \"creep\", \"probability\": 1.5}"), "candidates[0] (creep): 1.5"),
            (&candidates("{\"term\": \"creep\", \"probability\": 0.5}"), "sum to 0.5"),
            (
                &candidates(
                    "{\"term\": \"a\", \"probability\": 0.5}, {\"term\": \"a\", \"probability\": 0.5}",
                ),
                "candidates[1] (a): this candidate is given twice",
            ),
            (&file(", \"added\": \"creep\""), "expected a list, found \"creep\""),
        ] {
            let found = read(text).unwrap_err()[0].to_string();
            assert!(found.starts_with(DIAGNOSIS) && found.contains(expected), "{text}: {found}");
        }
    }
}
