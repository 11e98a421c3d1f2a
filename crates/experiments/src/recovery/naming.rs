//! A hidden effect through the diagnosis: is it named, and does the best wrong term win?

use hexbench_model::error::ModelError;
use hexbench_model::estimation::estimate::{estimates, stiffness_of};
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::inference::search::Set;
use hexbench_model::inference::verdict::Verdict;
use serde::{Deserialize, Serialize};

use super::campaign;
use super::scene::{HiddenSubject, RecoveryCampaign};
use super::tally::Tally;
use crate::{Outcome, Trial, TrialError};

/// Distance at which an effect is clear: a chi-square of 484 for one parameter.
pub const CLEAR_DISTANCE: f64 = 22.0;

/// What the diagnosis made of one campaign.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct NamingResult {
    /// Right, honest or wrong.
    pub outcome: Outcome,
    /// The answer, for the record: verdict and what was added.
    pub answer: String,
    /// True when the answer was given as sure.
    pub sure: bool,
    /// Pulls of the leg stiffnesses of the model that the diagnosis chose.
    pub stiffness: Tally,
    /// The right model against the best wrong one; `None` when the search looked at no wrong one.
    pub rival: Option<BestRival>,
}

/// The best explanation by terms that leaves a hidden effect out.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BestRival {
    /// Evidence of the right terms over it, nats.
    pub evidence: f64,
    /// Held-out chi-square per number of the right terms.
    pub holdout_right: f64,
    /// Held-out chi-square per number of the wrong terms.
    pub holdout_wrong: f64,
}

/// Diagnoses the `index`-th campaign of a subject.
pub(crate) fn run(subject: &HiddenSubject, index: usize, seed: u64) -> Result<NamingResult, TrialError> {
    let scene = RecoveryCampaign::draw(subject, index, seed, Some(CLEAR_DISTANCE))?;
    let trial = Trial::run(&scene.case)?;
    let d = &trial.study.diagnosis;
    Ok(NamingResult {
        outcome: trial.outcome(),
        answer: format!("{:?} {}", d.verdict, d.added.join(" + ")).trim_end().to_lowercase(),
        sure: d.verdict != Verdict::Ambiguous,
        stiffness: stiffness(&scene, &trial),
        rival: rival(subject, &scene, &trial)?,
    })
}

/// Leg stiffnesses as the diagnosis reports them.
fn stiffness(scene: &RecoveryCampaign, trial: &Trial) -> Tally {
    const PER_SI: f64 = 1e-6;
    let Some(last) = trial.study.fits.last() else { return Tally::default() };
    let found = estimates(last).determined;
    let pull = |(leg, k): (usize, &f64)| {
        let estimate = stiffness_of(&found, leg)?;
        Some((estimate.value - k * PER_SI) / estimate.std)
    };
    Tally::campaign(scene.leg_stiffness().iter().enumerate().filter_map(pull))
}

fn rival(
    subject: &HiddenSubject,
    scene: &RecoveryCampaign,
    trial: &Trial,
) -> Result<Option<BestRival>, ModelError> {
    let sets = &trial.study.outcome.sets.sets;
    let ids = |set: &Set| -> Option<Vec<&'static str>> {
        set.members.iter().map(|&m| trial.study.outcome.candidates[m].id()).collect()
    };
    let same = |found: &[&str]| {
        found.len() == subject.effects.len() && subject.effects.iter().all(|id| found.contains(id))
    };
    let right = sets.iter().find(|s| ids(s).is_some_and(|found| same(&found)));
    let misses = |found: &[&str]| {
        !found.is_empty()
            && (subject.effects.is_empty() || subject.effects.iter().any(|id| !found.contains(id)))
    };
    let wrong = sets.iter().find(|s| ids(s).is_some_and(|found| misses(&found)));
    let (Some(right), Some(wrong)) = (right, wrong) else { return Ok(None) };
    Ok(Some(BestRival {
        evidence: right.log_weight - wrong.log_weight,
        holdout_right: holdout(scene, trial, right)?,
        holdout_wrong: holdout(scene, trial, wrong)?,
    }))
}

/// Held-out chi-square per number with the terms of a set.
fn holdout(scene: &RecoveryCampaign, trial: &Trial, set: &Set) -> Result<f64, ModelError> {
    let o = &trial.study.outcome;
    let terms: Vec<TermSpec> = o.wanted(set);
    let campaign = &trial.study.campaign;
    campaign::holdout(scene, campaign, &fit(campaign, &terms, Some(&o.baseline.point))?)
}
