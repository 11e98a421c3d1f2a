//! One campaign through the diagnosis: right, honest or wrong.

use hexbench_model::error::ModelError;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, DiagnosisStudy, diagnose};
use hexbench_model::terms::catalogue;
use hexbench_truth::TruthError;
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::mechanisms::is_outside;
use serde::{Deserialize, Serialize};

/// How the answer of a diagnosis compares with the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Outcome {
    /// Exactly the hidden effects are named; nothing when there are none; "outside" when the catalogue lacks one.
    Right,
    /// The answer is ambiguous, and the hidden effects are among those it does not exclude.
    Honest,
    /// Anything else.
    Wrong,
}

hexbench_core::worded! {
    /// A word for tables.
    Outcome::word { Right => "right", Honest => "honest", Wrong => "wrong" }
}

/// A case and what was said about it.
pub struct Trial {
    /// Ids of the hidden effects; those outside the catalogue begin with `out:`.
    pub hidden: Vec<&'static str>,
    /// The diagnosis with its fitted steps.
    pub study: DiagnosisStudy,
}

/// Why a trial gave no answer.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// The campaign could not be made.
    #[error("the campaign could not be simulated: {0}")]
    Truth(#[from] TruthError),
    /// The campaign could not be diagnosed.
    #[error("the campaign could not be diagnosed: {0}")]
    Model(#[from] ModelError),
}

impl Trial {
    /// Diagnoses a case with its held-out part.
    ///
    /// # Errors
    /// [`TrialError::Model`].
    pub fn run(case: &SimulatedCase) -> Result<Self, TrialError> {
        let study = diagnose(&case.hexapod, &case.measurements, Some(&case.holdout), &catalogue())?;
        Ok(Self { hidden: case.spec.hidden_effects(), study })
    }

    /// Right, honest or wrong.
    pub fn outcome(&self) -> Outcome {
        outcome(&self.hidden, &self.study.diagnosis)
    }
}

/// Name and number of a trial that is called so: `pair` and 7 for `pair-0007`.
pub fn numbered(name: &str) -> Option<(&str, usize)> {
    const MOST_DIGITS: usize = 6;
    let (name, number) = name.rsplit_once('-').filter(|(_, number)| number.len() <= MOST_DIGITS)?;
    Some((name, number.parse().ok()?))
}

/// Clean machines and machines with one effect in turn: kind, and number within it.
pub(crate) fn clean_or_single(campaign: usize) -> (CaseKind, usize) {
    let kind = if campaign.is_multiple_of(2) { CaseKind::Clean } else { CaseKind::Single };
    (kind, campaign / 2)
}

/// An answer in one word: the effects named, or the verdict.
pub(crate) fn in_a_word(verdict: Verdict, added: &[String]) -> String {
    if verdict == Verdict::Named { added.join("+") } else { verdict.word().to_owned() }
}

/// Kinds of the findings in the words of the file, the first first.
pub fn kinds(d: &Diagnosis) -> Vec<String> {
    d.findings.iter().map(|finding| finding.kind.word().to_owned()).collect()
}

/// Right, honest or wrong about hidden effects. An effect that is told as sure, but too small to be named, is told.
pub fn outcome(hidden: &[&str], d: &Diagnosis) -> Outcome {
    let reported = reported(d);
    let small_alone = d.verdict == Verdict::Adequate && !reported.is_empty();
    let verdict = if small_alone { Verdict::Named } else { d.verdict };
    outcome_of(hidden, verdict, &reported, &d.credible_set)
}

/// Effects that a diagnosis says are there: those named, then those too small to be named.
pub fn reported(d: &Diagnosis) -> Vec<String> {
    d.added.iter().chain(&d.small).cloned().collect()
}

/// The same for an answer from anywhere: the verdict, the effects named, and those not excluded.
pub fn outcome_of(
    hidden: &[&str],
    verdict: Verdict,
    added: &[String],
    credible_set: &[Explanation],
) -> Outcome {
    let outside = hidden.iter().any(|id| is_outside(id));
    let same = added.len() == hidden.len() && hidden.iter().all(|id| added.iter().any(|a| a == id));
    let right = match verdict {
        Verdict::Outside => outside,
        Verdict::Adequate | Verdict::Measurement => hidden.is_empty(),
        Verdict::Named => !outside && !hidden.is_empty() && same,
        Verdict::Ambiguous | Verdict::Undecided => false,
    };
    let kept = |id: &&str| credible_set.iter().any(|e| e.is_term(id)) || added.iter().any(|a| a == id);
    let weighed = verdict == Verdict::Ambiguous && !outside && !hidden.is_empty() && hidden.iter().all(kept);
    let honest = weighed || verdict == Verdict::Undecided;
    match (right, honest) {
        (true, _) => Outcome::Right,
        (_, true) => Outcome::Honest,
        _ => Outcome::Wrong,
    }
}
