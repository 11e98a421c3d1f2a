//! One campaign through the diagnosis, in the numbers that limits are made of.

use hexbench_truth::campaign::Case;
use serde::{Deserialize, Serialize};

use crate::calibration::Record;
use crate::trial::{Trial, TrialError};

/// What was said about a campaign, and what it cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answered {
    /// The answer beside the truth.
    pub record: Record,
    /// Sets of effects weighed in the last round.
    pub sets: usize,
    /// Rounds of linearisation and search.
    pub rounds: usize,
}

impl Answered {
    /// Diagnoses a case.
    pub(crate) fn to(case: &Case) -> Result<Self, TrialError> {
        let trial = Trial::run(case)?;
        let outcome = &trial.study.outcome;
        Ok(Self {
            sets: outcome.sets.sets.len(),
            rounds: outcome.rounds,
            record: Record::of_trial(case, &trial),
        })
    }
}
