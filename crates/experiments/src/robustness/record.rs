//! One trial in numbers.

use hexbench_core::statistics::Proportion;
use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::campaign::SimulatedCase;
use hexbench_truth::laboratory;
use serde::{Deserialize, Serialize};

use super::RobustnessJob;
use crate::calibration::{self, COVERED};
use crate::harness::words::{self, Word};
use crate::trial::{Outcome, Trial, TrialError, kinds, outcome_of};

/// What was done to a campaign, and what was said about machine and data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobustnessRecord {
    /// Id of the fault.
    #[serde(with = "words")]
    pub fault: Word,
    /// Number of the campaign within its kind: the same for every fault.
    pub index: u64,
    /// What was hidden in the machine, and what was said about it.
    pub answer: calibration::CalibrationRecord,
    /// Kinds of the findings, as in `diagnosis.json`, the first first.
    pub findings: Vec<String>,
}

impl RobustnessRecord {
    /// Draws the campaign, diagnoses it and compares the answer with the truth.
    pub(crate) fn of(job: RobustnessJob, seed: u64) -> Result<Self, TrialError> {
        Self::of_case(job.fault.id, job.index, &super::protocol::sampled(job, seed)?)
    }

    /// Diagnoses a campaign and compares the answer with the truth.
    pub(crate) fn of_case(fault: Word, index: usize, case: &SimulatedCase) -> Result<Self, TrialError> {
        let trial = Trial::run(case)?;
        Ok(Self {
            fault,
            index: index as u64,
            findings: kinds(&trial.study.diagnosis),
            answer: calibration::CalibrationRecord::of_trial(case, &trial),
        })
    }

    /// True on a machine without effects.
    pub fn is_clean(&self) -> bool {
        self.answer.hidden.is_empty()
    }

    /// True when a clean machine is called so (whatever is said of the data), and when a hidden effect is the first one named.
    pub fn is_right(&self) -> bool {
        match self.answer.hidden.first() {
            None => matches!(self.answer.verdict, Verdict::Adequate | Verdict::Measurement),
            Some(hidden) => self.answer.added.first().is_some_and(|first| first == hidden),
        }
    }

    /// Exactly the truth, honestly open, or wrong.
    pub fn outcome(&self) -> Outcome {
        let a = &self.answer;
        outcome_of(&a.hidden, a.verdict, &a.added, &a.credible)
    }

    /// True when an effect is named, for sure or among others, that is not there.
    pub fn names_falsely(&self) -> bool {
        self.answer.added.iter().any(|id| !self.answer.contains(id))
    }

    /// True when a finding calls the fault by its name.
    pub fn tells_fault(&self) -> bool {
        let entry = laboratory::entry(self.fault);
        self.findings.iter().any(|kind| entry.is_some_and(|e| e.is_called(kind)))
    }

    /// True when a finding speaks of a fault that is not there.
    pub fn tells_another(&self) -> bool {
        let entry = laboratory::entry(self.fault);
        self.findings.iter().any(|kind| !entry.is_some_and(|e| e.is_called(kind)))
    }

    /// True when there is a finding of a kind.
    pub fn finds(&self, kind: &str) -> bool {
        self.findings.iter().any(|k| k == kind)
    }

    /// Leg stiffnesses within 1.96 of their stated standard deviations.
    pub fn stiffness_coverage(&self) -> Proportion {
        Proportion::count(self.answer.stiffness_z.iter().flatten(), |z| z.abs() <= COVERED)
    }
}
