//! One campaign through the diagnosis, in the numbers that limits are made of.

use hexbench_truth::campaign::SimulatedCase;
use serde::{Deserialize, Serialize};

use crate::calibration::CalibrationRecord;
use crate::trial::{Trial, TrialError};

/// What was said about a campaign, and what it cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answered {
    /// The answer beside the truth.
    pub record: CalibrationRecord,
    /// Sets of effects weighed in the last round.
    pub sets: usize,
    /// Rounds of linearization and search.
    pub rounds: usize,
}

impl Answered {
    /// Diagnoses a case.
    pub(crate) fn to(case: &SimulatedCase) -> Result<Self, TrialError> {
        let trial = Trial::run(case)?;
        let outcome = &trial.study.outcome;
        Ok(Self {
            sets: outcome.sets.sets.len(),
            rounds: outcome.rounds,
            record: CalibrationRecord::of_trial(case, &trial),
        })
    }
}
