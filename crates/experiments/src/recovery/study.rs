//! The whole study: campaigns of every subject, gathered into rows, and the bounds that are broken.

use hexbench_core::statistics::{mean, median};
use serde::Serialize;

use super::campaign::CampaignResult;
use super::naming::{BestRival, NamingResult};
use super::noiseless::Bounded;
use super::protocol::{Recovery, RecoveryRecord};
use super::scene::{HiddenSubject, subjects};
use super::tally::{Coverage, Tally};
use crate::Outcome;
use crate::harness::{Gathered, Protocol};

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct RecoverySettings {
    /// Noisy campaigns in all, shared out evenly.
    pub campaigns: usize,
    /// Diagnoses of each subject.
    pub diagnoses: usize,
    /// Decides everything that is drawn.
    pub seed: u64,
}

impl Default for RecoverySettings {
    fn default() -> Self {
        Self { campaigns: 2000, diagnoses: 10, seed: 1 }
    }
}

impl RecoverySettings {
    /// Campaigns of each subject, rounded up.
    pub fn per_subject(&self) -> usize {
        self.campaigns.div_ceil(subjects().len())
    }

    /// Campaigns and diagnoses in all.
    pub fn steps(&self) -> usize {
        subjects().len() * (self.per_subject() + self.diagnoses)
    }
}

/// One row of the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecoveryRow {
    /// What was hidden.
    pub subject: &'static str,
    /// Largest error of leg stiffness without noise against its bound.
    pub noiseless_stiffness: Option<Bounded>,
    /// Largest error of the effect's numbers without noise against its bound.
    pub noiseless_effect: Option<Bounded>,
    /// Intervals of leg stiffnesses.
    pub stiffness: Option<Coverage>,
    /// Intervals of effect sizes; for geometry, of determined combinations.
    pub sizes: Option<Coverage>,
    /// Intervals of shapes (exponent, time constant, pitch), as factors.
    pub shapes: Option<Coverage>,
    /// Campaigns in which the right model does not fit.
    pub misfits: usize,
    /// Numbers left open by the data, mean per campaign.
    pub open: f64,
    /// Held-out readings within the 95 % region of their prediction.
    pub predicted: Option<Coverage>,
    /// Median held-out chi-square per number with springs alone.
    pub holdout_before: f64,
    /// The same with the right model.
    pub holdout_after: f64,
    /// Diagnoses right, honest, wrong.
    pub named: [usize; 3],
    /// Answers of the diagnoses that were wrong.
    pub wrong_answers: Vec<String>,
    /// Median held-out chi-square per number with the best wrong terms, in the diagnoses.
    pub holdout_wrong: Option<f64>,
    /// Diagnoses in which the best wrong terms have more evidence than the right ones.
    pub wrong_wins_evidence: usize,
    /// Diagnoses in which they predict better.
    pub wrong_wins_holdout: usize,
    /// Diagnoses that compared right and wrong terms.
    pub compared: usize,
}

/// The study with its sums over all subjects.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecoveryStudy {
    /// `recovery/1`.
    pub format: &'static str,
    /// What was run.
    pub settings: RecoverySettings,
    /// One per subject.
    pub rows: Vec<RecoveryRow>,
    /// Leg stiffnesses of all campaigns.
    pub stiffness: Option<Coverage>,
    /// Effect sizes of all campaigns.
    pub sizes: Option<Coverage>,
    /// Shapes of all campaigns.
    pub shapes: Option<Coverage>,
    /// Leg stiffnesses when the noise level comes from the repeats.
    pub stiffness_by_repeats: Option<Coverage>,
    /// Noise levels from repeats.
    pub noise_by_repeats: Option<Coverage>,
    /// Noise levels from residuals.
    pub noise_by_residuals: Option<Coverage>,
    /// Leg stiffnesses of the model that the diagnosis chose.
    pub stiffness_after_search: Option<Coverage>,
    /// The same where its answer is right.
    pub stiffness_after_right_search: Option<Coverage>,
    /// Answers given as sure, and those of them that are wrong.
    pub sure: [usize; 2],
    /// Campaigns that could not be made or fitted, with the reason.
    pub failures: Vec<String>,
    /// Bounds in the table.
    pub bounds: usize,
    /// Bounds that are broken, in words.
    pub broken: Vec<String>,
}

impl RecoveryStudy {
    /// Everything the trials of the study show.
    pub fn of(protocol: &Recovery, gathered: &Gathered<RecoveryRecord>) -> Self {
        let good: Vec<&CampaignResult> = gathered.records().filter_map(RecoveryRecord::found).collect();
        let answers: Vec<&NamingResult> = gathered.records().filter_map(RecoveryRecord::named).collect();
        let over = |of: fn(&CampaignResult) -> Tally| good.iter().map(|f| of(f)).sum::<Tally>().coverage(1);
        let after = |right_only: bool| {
            let kept = answers.iter().filter(|n| !right_only || n.outcome == Outcome::Right);
            kept.map(|n| n.stiffness).sum::<Tally>().coverage(1)
        };
        let sure = answers.iter().filter(|n| n.sure);
        let answered = || protocol.jobs().into_iter().zip(&gathered.answers);
        let failures =
            answered().filter_map(|(job, a)| Some(format!("{}: {}", job.subject.name, a.as_ref().err()?)));
        let of_subject = |subject: &HiddenSubject| {
            let own = answered().filter(|(job, _)| job.subject == *subject);
            let records: Vec<&RecoveryRecord> = own.filter_map(|(_, a)| a.as_ref().ok()).collect();
            row(subject, protocol.subjects.len(), &records)
        };
        let mut study = Self {
            format: "recovery/1",
            settings: protocol.settings,
            rows: protocol.subjects.iter().map(of_subject).collect(),
            stiffness: over(|f| f.stiffness),
            sizes: over(|f| f.sizes),
            shapes: over(|f| f.shapes),
            stiffness_by_repeats: over(|f| f.stiffness_by_repeats),
            noise_by_repeats: over(|f| f.noise_by_repeats),
            noise_by_residuals: over(|f| f.noise_by_residuals),
            stiffness_after_search: after(false),
            stiffness_after_right_search: after(true),
            sure: [sure.clone().count(), sure.filter(|n| n.outcome == Outcome::Wrong).count()],
            failures: failures.collect(),
            bounds: 0,
            broken: Vec::new(),
        };
        let checks = super::check::checks(&study);
        study.bounds = checks.len();
        study.broken = checks.into_iter().filter_map(|c| (!c.holds).then_some(c.text)).collect();
        study
    }
}

fn row(subject: &HiddenSubject, rows: usize, records: &[&RecoveryRecord]) -> RecoveryRow {
    let found: Vec<&CampaignResult> = records.iter().filter_map(|r| r.found()).collect();
    let named: Vec<&NamingResult> = records.iter().filter_map(|r| r.named()).collect();
    let over = |of: fn(&CampaignResult) -> Tally| found.iter().map(|f| of(f)).sum::<Tally>().coverage(rows);
    let count = |outcome: Outcome| named.iter().filter(|n| n.outcome == outcome).count();
    let rivals: Vec<&BestRival> = named.iter().filter_map(|n| n.rival.as_ref()).collect();
    let wrong = named.iter().filter(|n| n.outcome == Outcome::Wrong);
    RecoveryRow {
        subject: subject.name,
        noiseless_stiffness: found.iter().filter_map(|f| f.noiseless.stiffness).reduce(Bounded::worse),
        noiseless_effect: found.iter().filter_map(|f| f.noiseless.effect).reduce(Bounded::worse),
        stiffness: over(|f| f.stiffness),
        sizes: over(|f| f.sizes),
        shapes: over(|f| f.shapes),
        misfits: found.iter().filter(|f| f.misfit).count(),
        open: mean(found.iter().map(|f| f.open as f64)).unwrap_or(0.0),
        predicted: over(|f| f.predicted),
        holdout_before: median(found.iter().map(|f| f.holdout_before)).unwrap_or(f64::NAN),
        holdout_after: median(found.iter().map(|f| f.holdout_after)).unwrap_or(f64::NAN),
        named: [Outcome::Right, Outcome::Honest, Outcome::Wrong].map(count),
        wrong_answers: wrong.map(|n| n.answer.clone()).collect(),
        holdout_wrong: median(rivals.iter().map(|r| r.holdout_wrong)),
        wrong_wins_evidence: rivals.iter().filter(|r| r.evidence < 0.0).count(),
        wrong_wins_holdout: rivals.iter().filter(|r| r.holdout_wrong < r.holdout_right).count(),
        compared: rivals.len(),
    }
}
