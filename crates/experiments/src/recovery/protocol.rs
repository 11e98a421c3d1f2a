//! Recovery as an experiment: noisy campaigns of every subject, then diagnoses of every subject.

use hexbench_core::streams::{Purpose, derived_seed};
use serde::{Deserialize, Serialize};

use super::campaign::{self, Found};
use super::naming::{self, Named};
use super::scene::{Subject, subjects};
use super::study::Settings;
use crate::TrialError;
use crate::harness::{Field, Protocol};
use crate::journal::Identity;

/// All campaigns and diagnoses.
pub struct Recovery {
    pub(super) settings: Settings,
    pub(super) subjects: Vec<Subject>,
}

/// What is known of one trial.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum Record {
    /// A campaign fitted by the right model.
    Fitted(Box<Found>),
    /// A campaign that was diagnosed.
    Diagnosed(Named),
}

impl Recovery {
    /// The study of these settings.
    pub fn new(settings: Settings) -> Self {
        Self { settings, subjects: subjects() }
    }

    /// Trials that are fitted; the others are diagnosed.
    fn fitted(&self) -> usize {
        self.subjects.len() * self.settings.per_subject()
    }

    /// Number of the subject, and of the trial within its own.
    pub(super) fn place(&self, number: u64) -> (usize, usize) {
        let number = usize::try_from(number).unwrap_or(usize::MAX);
        let (number, of_each) = match number.checked_sub(self.fitted()) {
            None => (number, self.settings.per_subject()),
            Some(number) => (number, self.settings.diagnoses),
        };
        (number / of_each, number % of_each)
    }
}

impl Protocol for Recovery {
    type Record = Record;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let Settings { campaigns, diagnoses, seed } = self.settings;
        let settings = [("campaigns", campaigns as u64), ("diagnoses", diagnoses as u64), ("seed", seed)];
        Identity::new("recovery", "recovery-trials/2", settings.map(|(name, n)| (name, n.to_string())))
    }

    fn trials(&self) -> u64 {
        self.settings.steps() as u64
    }

    fn trial(&self, number: u64) -> Result<Record, TrialError> {
        let (subject, index) = self.place(number);
        let subject = &self.subjects[subject];
        let seed = self.settings.seed;
        if number < self.fitted() as u64 {
            return Ok(Record::Fitted(Box::new(campaign::run(subject, index, seed)?)));
        }
        Ok(Record::Diagnosed(naming::run(
            subject,
            index,
            derived_seed(seed, Purpose::RecoveryDiagnoses, []),
        )?))
    }

    fn name(&self, number: u64) -> String {
        let (subject, index) = self.place(number);
        format!("{}-{index}", self.subjects[subject].name)
    }

    fn fields(&self) -> Vec<Field<Record>> {
        vec![
            Field::text(
                "what",
                "what was done: fitted by the right model, or diagnosed",
                |r: &Record| match r {
                    Record::Fitted(_) => "fitted",
                    Record::Diagnosed(_) => "diagnosed",
                },
            ),
            fitted("misfit", "1 where the right model does not fit", |f| f64::from(u8::from(f.misfit))),
            fitted("open", "numbers that the data leave open", |f| f.open as f64),
            fitted("holdout_before", "held-out chi-square per number, springs alone", |f| f.holdout_before),
            fitted("holdout_after", "held-out chi-square per number, right model", |f| f.holdout_after),
            Field::text("outcome", "right, honest or wrong", |r: &Record| {
                r.named().map_or("", |n| n.outcome.word())
            }),
            Field::text("answer", "verdict and what was named", |r: &Record| {
                r.named().map_or(String::new(), |n| n.answer.clone())
            }),
        ]
    }
}

fn fitted(name: &str, meaning: &'static str, value: fn(&Found) -> f64) -> Field<Record> {
    Field::number((name, "1"), meaning, move |r: &Record| r.found().map(value))
}

impl Record {
    /// The campaign, when it was fitted.
    pub(super) fn found(&self) -> Option<&Found> {
        if let Self::Fitted(found) = self { Some(found) } else { None }
    }

    /// The diagnosis, when it was diagnosed.
    pub(super) fn named(&self) -> Option<&Named> {
        if let Self::Diagnosed(named) = self { Some(named) } else { None }
    }
}
