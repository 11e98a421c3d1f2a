//! Running the protocol.

use hexbench_truth::campaign::{CaseKind, SimulatedCase};

use super::{CalibrationProtocol, CalibrationRecord, DISTANCES};
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::TrialError;

/// All trials of a protocol.
pub type Calibration = Study<CalibrationProtocol>;

/// The campaign of one trial.
///
/// # Errors
/// [`TrialError::Truth`] when the effect shows in no plan and machine tried.
pub fn case(kind: CaseKind, index: usize, seed: u64) -> Result<SimulatedCase, TrialError> {
    Ok(SimulatedCase::draw(kind, index, seed, Some(DISTANCES))?)
}

/// A column of the table of trials.
type Column = Field<CalibrationRecord>;

impl harness::Protocol for CalibrationProtocol {
    /// Kind, and number within the kind.
    type Job = (CaseKind, usize);
    type Record = CalibrationRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let portions = self.portions.iter().map(|p| format!("{} {}", p.kind.name(), p.trials));
        let portions = portions.collect::<Vec<_>>().join(", ");
        let settings = [("portions", portions), ("seed", self.seed.to_string())];
        Identity::new("calibration", "calibration-trials/3", settings)
    }

    fn jobs(&self) -> Vec<(CaseKind, usize)> {
        self.portions.iter().flat_map(|p| (0..p.trials).map(|index| (p.kind, index))).collect()
    }

    fn trial(&self, &(kind, index): &(CaseKind, usize)) -> Result<CalibrationRecord, TrialError> {
        CalibrationRecord::of(&case(kind, index, self.seed)?)
    }

    fn name(&self, (kind, index): &(CaseKind, usize)) -> String {
        format!("{}-{index:04}", kind.name())
    }

    fn fields(&self) -> Vec<Column> {
        vec![
            Column::text("hidden", "hidden effects", CalibrationRecord::hidden_words),
            Column::text("family", "family of the machine", |r| r.family),
            Column::text("plan", "plan of the measurements", |r| r.plan.name()),
            Column::number("distance", "distance of the effects together", |r| r.total_distance),
            Column::text("answer", "effects named, or the verdict", CalibrationRecord::answer),
            Column::text("fate", "what became of the truth", |r| r.fate.word()),
            Column::number("confidence", "probability of exactly the verdict", |r| r.confidence),
            Column::number("truth", "probability of exactly the truth", |r| r.truth),
            Column::number("outside", "probability of something outside the catalogue", |r| r.outside),
            Column::number("none", "probability of no effect", |r| r.none),
            Column::number("holdout_springs", "held-out chi-square per number, springs", |r| r.holdout[0]),
            Column::number("holdout_final", "the same of the final model", |r| r.holdout[1]),
        ]
    }
}
