//! The frozen protocol: which truths, how large, how many.

use hexbench_truth::campaign::{CaseKind, SimulatedCase};

use super::CalibrationRecord;
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::TrialError;

/// Seed of the committed figures.
pub const SEED: u64 = 20_260;

/// Distances of the hidden effects, log-uniform: from what no test could see to what nobody overlooks.
pub const DISTANCES: [f64; 2] = [2.0, 60.0];

/// Trials of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TrialPortion {
    /// Kind of campaign.
    pub kind: CaseKind,
    /// How many.
    pub trials: usize,
}

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CalibrationProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Kinds and counts.
    pub portions: Vec<TrialPortion>,
}

/// Counts of the committed study. Single effects are many because each of the sixteen gets a curve of its own.
const STANDARD: [TrialPortion; 8] = [
    TrialPortion { kind: CaseKind::Single, trials: 2400 },
    TrialPortion { kind: CaseKind::Pair, trials: 800 },
    TrialPortion { kind: CaseKind::Outside, trials: 900 },
    TrialPortion { kind: CaseKind::Clean, trials: 1000 },
    TrialPortion { kind: CaseKind::SeedProtocol, trials: 400 },
    TrialPortion { kind: CaseKind::Absolute, trials: 200 },
    TrialPortion { kind: CaseKind::RichForm, trials: 300 },
    TrialPortion { kind: CaseKind::Triple, trials: 400 },
];

impl Default for CalibrationProtocol {
    fn default() -> Self {
        Self { seed: SEED, portions: STANDARD.to_vec() }
    }
}

impl CalibrationProtocol {
    /// The same mix with about so many trials; every kind keeps at least one.
    #[must_use]
    pub fn with_trials(self, trials: usize) -> Self {
        let all = self.trials();
        let share = |p: TrialPortion| TrialPortion { trials: (p.trials * trials).div_ceil(all).max(1), ..p };
        Self { portions: self.portions.into_iter().map(share).collect(), ..self }
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Trials of all kinds.
    pub fn trials(&self) -> usize {
        self.portions.iter().map(|p| p.trials).sum()
    }
}

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
