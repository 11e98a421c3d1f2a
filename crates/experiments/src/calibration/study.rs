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

impl harness::Protocol for CalibrationProtocol {
    type Record = CalibrationRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let portions = self.portions.iter().map(|p| format!("{} {}", p.kind.name(), p.trials));
        let portions = portions.collect::<Vec<_>>().join(", ");
        let settings = [("portions", portions), ("seed", self.seed.to_string())];
        Identity::new("calibration", "calibration-trials/3", settings)
    }

    fn trials(&self) -> u64 {
        self.trials() as u64
    }

    fn trial(&self, number: u64) -> Result<CalibrationRecord, TrialError> {
        let (kind, index) = self.job(number);
        CalibrationRecord::of(&case(kind, index, self.seed)?)
    }

    fn name(&self, number: u64) -> String {
        let (kind, index) = self.job(number);
        format!("{}-{index:04}", kind.name())
    }

    fn fields(&self) -> Vec<Field<CalibrationRecord>> {
        let p = |name| (name, "1");
        vec![
            Field::text("hidden", "hidden effects", CalibrationRecord::hidden_words),
            Field::text("family", "family of the machine", |r: &CalibrationRecord| r.family),
            Field::text("plan", "plan of the measurements", |r: &CalibrationRecord| r.plan.name()),
            Field::number(p("distance"), "distance of the effects together", |r: &CalibrationRecord| {
                r.total_distance
            }),
            Field::text("answer", "effects named, or the verdict", CalibrationRecord::answer),
            Field::text("fate", "what became of the truth", |r: &CalibrationRecord| r.fate.word()),
            Field::number(p("confidence"), "probability of exactly the verdict", |r: &CalibrationRecord| {
                r.confidence
            }),
            Field::number(p("truth"), "probability of exactly the truth", |r: &CalibrationRecord| r.truth),
            Field::number(
                p("outside"),
                "probability of something outside the catalogue",
                |r: &CalibrationRecord| r.outside,
            ),
            Field::number(p("none"), "probability of no effect", |r: &CalibrationRecord| r.none),
            Field::number(
                p("holdout_springs"),
                "held-out chi-square per number, springs",
                |r: &CalibrationRecord| r.holdout[0],
            ),
            Field::number(p("holdout_final"), "the same of the final model", |r: &CalibrationRecord| {
                r.holdout[1]
            }),
        ]
    }
}
