//! Recovery as an experiment: noisy campaigns of every subject, then diagnoses of every subject.

use hexbench_core::streams::{Purpose, derived_seed};
use serde::{Deserialize, Serialize};

use super::campaign::{self, CampaignResult};
use super::naming::{self, NamingResult};
use super::scene::{HiddenSubject, subjects};
use super::study::RecoverySettings;
use crate::TrialError;
use crate::harness::{Field, Protocol};
use crate::journal::Identity;

/// All campaigns and diagnoses.
pub struct Recovery {
    pub(super) settings: RecoverySettings,
    pub(super) subjects: Vec<HiddenSubject>,
}

/// A campaign of a subject.
#[derive(Debug, Clone, Copy)]
pub struct RecoveryJob {
    pub(super) subject: HiddenSubject,
    /// Number within the campaigns of the subject that are fitted, or that are diagnosed.
    index: usize,
    /// Fitted by the right model; else diagnosed.
    is_fitted: bool,
}

/// What is known of one trial.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum RecoveryRecord {
    /// A campaign fitted by the right model.
    Fitted(Box<CampaignResult>),
    /// A campaign that was diagnosed.
    Diagnosed(NamingResult),
}

impl Recovery {
    /// The study of these settings.
    pub fn new(settings: RecoverySettings) -> Self {
        Self { settings, subjects: subjects() }
    }
}

/// A column of the table of trials.
type Column = Field<RecoveryRecord>;

impl Protocol for Recovery {
    type Job = RecoveryJob;
    type Record = RecoveryRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let RecoverySettings { campaigns, diagnoses, seed } = self.settings;
        let settings = [("campaigns", campaigns as u64), ("diagnoses", diagnoses as u64), ("seed", seed)];
        Identity::new("recovery", "recovery-trials/2", settings.map(|(name, n)| (name, n.to_string())))
    }

    fn jobs(&self) -> Vec<RecoveryJob> {
        let of_each = |campaigns: usize, is_fitted| {
            let of =
                move |&subject| (0..campaigns).map(move |index| RecoveryJob { subject, index, is_fitted });
            self.subjects.iter().flat_map(of)
        };
        of_each(self.settings.per_subject(), true).chain(of_each(self.settings.diagnoses, false)).collect()
    }

    fn trial(&self, job: &RecoveryJob) -> Result<RecoveryRecord, TrialError> {
        let RecoveryJob { subject, index, is_fitted } = job;
        let seed = self.settings.seed;
        if *is_fitted {
            return Ok(RecoveryRecord::Fitted(Box::new(campaign::run(subject, *index, seed)?)));
        }
        let seed = derived_seed(seed, Purpose::RecoveryDiagnoses, []);
        Ok(RecoveryRecord::Diagnosed(naming::run(subject, *index, seed)?))
    }

    fn name(&self, job: &RecoveryJob) -> String {
        format!("{}-{}", job.subject.name, job.index)
    }

    fn fields(&self) -> Vec<Column> {
        vec![
            Column::text("what", "what was done: fitted by the right model, or diagnosed", |r| match r {
                RecoveryRecord::Fitted(_) => "fitted",
                RecoveryRecord::Diagnosed(_) => "diagnosed",
            }),
            fitted("misfit", "1 where the right model does not fit", |f| f64::from(u8::from(f.misfit))),
            fitted("open", "numbers that the data leave open", |f| f.open as f64),
            fitted("holdout_before", "held-out chi-square per number, springs alone", |f| f.holdout_before),
            fitted("holdout_after", "held-out chi-square per number, right model", |f| f.holdout_after),
            Column::text("outcome", "right, honest or wrong", |r| r.named().map_or("", |n| n.outcome.word())),
            Column::text("answer", "verdict and what was named", |r| {
                r.named().map_or(String::new(), |n| n.answer.clone())
            }),
        ]
    }
}

fn fitted(name: &str, meaning: &'static str, value: fn(&CampaignResult) -> f64) -> Field<RecoveryRecord> {
    Column::number(name, meaning, move |r| r.found().map(value))
}

impl RecoveryRecord {
    /// The campaign, when it was fitted.
    pub(super) fn found(&self) -> Option<&CampaignResult> {
        if let Self::Fitted(found) = self { Some(found) } else { None }
    }

    /// The diagnosis, when it was diagnosed.
    pub(super) fn named(&self) -> Option<&NamingResult> {
        if let Self::Diagnosed(named) = self { Some(named) } else { None }
    }
}
