//! One trial in numbers.

use std::collections::{BTreeMap, BTreeSet};

use hexbench_core::statistics::Proportion;
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::predict;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::fit_named::{Added, fit_wanted};
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::inference::discrepancy::LegDiscrepancy;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::DiagnosisStudy;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{CaseKind, PlanKind, SimulatedCase};
use hexbench_truth::mechanisms::is_outside;
use serde::{Deserialize, Serialize};

use super::Fate;
use super::trust::COVERED;
use crate::harness::words::{self, Word};
use crate::trial::{Trial, TrialError, in_a_word, reported};

/// What was hidden in a campaign, and what was said about it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CalibrationRecord {
    /// Kind and number, as the folder of the case would be called.
    pub id: String,
    /// Kind of the campaign.
    pub kind: CaseKind,
    /// Family of the machine.
    #[serde(with = "words")]
    pub family: Word,
    /// Plan of the measurements.
    pub plan: PlanKind,
    /// Seed of the case itself.
    pub seed: u64,
    /// Ids of the hidden effects as the catalogue calls them; `out:` in front of those it lacks.
    #[serde(with = "words::list")]
    pub hidden: Vec<Word>,
    /// Distance each effect was scaled to; none where effects have their usual size.
    pub distance: Option<f64>,
    /// Distance of the effects together, 0 without effects.
    pub total_distance: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// What became of the truth.
    pub fate: Fate,
    /// Effects named.
    pub added: Vec<String>,
    /// Terms of the fitted model.
    pub model: Vec<String>,
    /// The best first addition and its probability.
    pub best: (Explanation, f64),
    /// Probability that an effect is present at all.
    pub present: BTreeMap<String, f64>,
    /// Probability of something outside the catalogue.
    pub outside: f64,
    /// Probability of no effect.
    pub none: f64,
    /// Probability of exactly what the verdict says; none when it is ambiguous.
    pub confidence: Option<f64>,
    /// Probability of exactly the truth.
    pub truth: f64,
    /// Effects that hold 95 % of the probability.
    pub credible: Vec<Explanation>,
    /// Reduced chi-square on held-out poses: springs alone, and the final model.
    pub holdout: [Option<f64>; 2],
    /// Errors of the leg stiffnesses of the final model, in standard deviations.
    pub stiffness_z: [Option<f64>; 6],
    /// Chi-square of the answer over that of a fit of the hidden effects themselves, where two or more of the catalogue are hidden.
    pub behind_truth: Option<f64>,
    /// Held-out numbers within 1.96 of the standard deviation of prediction and noise; none of absolute poses.
    pub predicted: Proportion,
}

impl CalibrationRecord {
    /// Diagnoses a case and compares the answer with the truth.
    pub(crate) fn of(case: &SimulatedCase) -> Result<Self, TrialError> {
        let trial = Trial::run(case)?;
        let predicted = predicted(&trial.study, case)?;
        let behind_truth = behind_truth(&trial)?;
        Ok(Self { behind_truth, predicted, ..Self::of_trial(case, &trial) })
    }

    /// Compares the answer to a case with its truth; nothing is predicted or fitted.
    pub fn of_trial(case: &SimulatedCase, trial: &Trial) -> Self {
        let Trial { hidden, study } = trial;
        let d = &study.diagnosis;
        let first =
            |e: &Explanation| d.candidates.iter().find(|c| c.term == *e).map_or(0.0, |c| c.probability);
        let best = d.candidates.first();
        let chi2 =
            |step: Option<&hexbench_model::results::diagnose::StepReport>| Some(step?.holdout?.chi2_reduced);
        Self {
            id: case.spec.id.clone(),
            kind: case.spec.kind,
            family: case.spec.family,
            plan: case.spec.plan,
            seed: case.spec.seed,
            distance: case.spec.distance,
            total_distance: case.truth["distance"].as_f64().unwrap_or(0.0),
            verdict: d.verdict,
            fate: Fate::of(trial),
            added: d.added.clone(),
            model: d.model.clone(),
            best: best.map_or((Explanation::Nothing, 1.0), |c| (c.term.clone(), c.probability)),
            present: d.present.clone(),
            outside: first(&Explanation::Outside),
            none: first(&Explanation::Nothing),
            confidence: confidence(study),
            truth: probability_of(study, hidden),
            credible: d.credible_set.clone(),
            holdout: [chi2(d.steps.first()), chi2(d.steps.last())],
            stiffness_z: stiffness_z(study, case),
            behind_truth: None,
            predicted: Proportion::default(),
            hidden: hidden.clone(),
        }
    }

    /// True when the catalogue lacks what is hidden.
    pub fn is_outside(&self) -> bool {
        self.hidden.iter().any(|id| is_outside(id))
    }

    /// True when an effect is hidden.
    pub fn contains(&self, id: &str) -> bool {
        self.hidden.contains(&id)
    }

    /// True when an explanation is part of the truth.
    pub fn holds(&self, explanation: &Explanation) -> bool {
        match explanation {
            Explanation::Outside => self.is_outside(),
            Explanation::Nothing => self.hidden.is_empty(),
            Explanation::Term(id) => self.contains(id),
        }
    }

    /// True when the credible set, or what is named for sure, holds all of the truth.
    pub fn is_covered(&self) -> bool {
        let kept = |e: &Explanation| self.credible.contains(e);
        let named = |id: &str| self.added.iter().any(|a| a == id);
        match (self.is_outside(), self.hidden.is_empty()) {
            (true, _) => kept(&Explanation::Outside),
            (_, true) => kept(&Explanation::Nothing),
            _ => self.hidden.iter().all(|id| named(id) || kept(&Explanation::from(*id))),
        }
    }

    /// The hidden effects in one word, `none` when there are none.
    pub fn hidden_words(&self) -> String {
        if self.hidden.is_empty() { Explanation::Nothing.into() } else { self.hidden.join("+") }
    }

    /// The answer in one word: the effects named, or the verdict.
    pub fn answer(&self) -> String {
        in_a_word(self.verdict, &self.added)
    }
}

fn confidence(study: &DiagnosisStudy) -> Option<f64> {
    let d = &study.diagnosis;
    let reported = reported(d);
    let reported: Vec<&str> = reported.iter().map(String::as_str).collect();
    match d.verdict {
        Verdict::Named | Verdict::Adequate | Verdict::Measurement => Some(probability_of(study, &reported)),
        Verdict::Outside => Some(probability_outside(study)),
        Verdict::Ambiguous | Verdict::Undecided => None,
    }
}

/// Probability that exactly these effects are at work; of anything outside when one of them is.
fn probability_of(study: &DiagnosisStudy, effects: &[&str]) -> f64 {
    if effects.iter().any(|id| is_outside(id)) {
        return probability_outside(study);
    }
    let wanted: BTreeSet<&str> = effects.iter().copied().collect();
    let sets = &study.outcome.sets;
    let members = |s: &hexbench_model::inference::search::Set| -> Option<BTreeSet<&str>> {
        s.members.iter().map(|&m| study.outcome.candidates[m].id()).collect()
    };
    let exactly = sets.sets.iter().filter(|s| members(s).is_some_and(|m| m == wanted));
    exactly.map(|s| sets.probability(s)).sum()
}

fn probability_outside(study: &DiagnosisStudy) -> f64 {
    let candidates = study.diagnosis.candidates.iter();
    candidates.filter(|c| c.term == Explanation::Outside).map(|c| c.probability).sum()
}

fn stiffness_z(study: &DiagnosisStudy, case: &SimulatedCase) -> [Option<f64>; 6] {
    let truth = case.campaign.world.leg_stiffness_n_per_um();
    std::array::from_fn(|leg| {
        let estimate = study.diagnosis.stiffness(leg)?;
        (estimate.std > 0.0).then(|| (estimate.value - truth[leg]) / estimate.std)
    })
}

/// How much better than the answer the hidden effects fit the readings that the answer judged.
fn behind_truth(trial: &Trial) -> Result<Option<f64>, ModelError> {
    let Trial { hidden, study } = trial;
    if hidden.len() < 2 || hidden.iter().any(|id| is_outside(id)) {
        return Ok(None);
    }
    let terms: Vec<_> = hidden.iter().map(|id| Added::named(id, &catalogue())).collect::<Result<_, _>>()?;
    // What the file cannot test, or leaves open, is no better answer.
    let Ok((_, truth)) = fit_wanted(&study.campaign, &terms) else { return Ok(None) };
    let answer = study.fits.last().unwrap_or(&study.outcome.baseline);
    Ok(Some(answer.lack_of_fit - truth.lack_of_fit))
}

/// The final model, as wide as what it leaves of the legs, at the held-out poses.
fn predicted(study: &DiagnosisStudy, case: &SimulatedCase) -> Result<Proportion, ModelError> {
    if study.campaign.is_absolute() {
        return Ok(Proportion::default());
    }
    let last = study.fits.last().unwrap_or(&study.outcome.baseline);
    let lin = Linearization::at(&study.campaign, &last.point)?;
    let left = LegDiscrepancy::of(&study.campaign, &lin, last.lack_of_fit_dof);
    let model = Model::new(&study.campaign, last, Estimator::Gls, DataOrigin::default()).open_by(&left.share);
    let held = &case.holdout.observations;
    let predictions = predict(&model, held).map_err(|error| error.cause)?;
    let noise = study.campaign.noise.sigma();
    let z = predictions.iter().zip(held).flat_map(|(p, o)| {
        std::array::from_fn::<f64, 6, _>(|k| (o.measured[k] - p.value[k]) / p.sigma[k].hypot(noise[k]))
    });
    Ok(Proportion::count(z, |z| z.abs() <= COVERED))
}
