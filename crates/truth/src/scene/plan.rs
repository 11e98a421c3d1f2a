//! The plan of a scene, and changes of its size.

use hexbench_core::Measurand;
use hexbench_core::files::{Fault, FilePlace, FileProblem};

use super::{PartName, PlanPart, Streams, part::Source};
use crate::campaign::{PlanRow, Poses, Scheme, Schemes};

/// Most rows of a part.
const MOST_ROWS: u64 = 1_000_000_000;

/// What is done to the machine of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum ScenePlan {
    /// Every pose under every load.
    Schemes(Box<Schemes>),
    /// Rows as a table lists them.
    Rows {
        /// What is read.
        measurand: Measurand,
        /// Rows to learn from.
        training: Vec<PlanRow>,
        /// Rows to judge by.
        holdout: Vec<PlanRow>,
        /// Readings of each training row.
        repeats: u64,
    },
}

/// Why a plan cannot have a size.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// The poses are listed.
    #[error("the poses of this scene are listed one by one; their number cannot be changed")]
    ListedPoses,
    /// Nothing is left, or too much.
    #[error("a part of the plan would have {rows} rows; it must have 1 to {MOST_ROWS}")]
    Size {
        /// Rows asked for.
        rows: u128,
    },
}

impl ScenePlan {
    /// What is read.
    pub fn measurand(&self) -> Measurand {
        match self {
            Self::Schemes(schemes) => schemes.training.measurand,
            Self::Rows { measurand, .. } => *measurand,
        }
    }

    /// True when every row says for how long the reference load had rested.
    pub fn states_reference_age(&self) -> bool {
        match self {
            Self::Schemes(schemes) => schemes.training.reference_age.is_some(),
            Self::Rows { training, holdout, .. } => {
                training.iter().chain(holdout).all(|row| row.situation.reference_age.is_some())
            }
        }
    }

    /// True when every row says when it comes in the sequence of loads.
    pub fn states_order(&self) -> bool {
        match self {
            Self::Schemes(schemes) => schemes.training.in_sequence,
            Self::Rows { training, holdout, .. } => {
                training.iter().chain(holdout).all(|row| row.order.is_some())
            }
        }
    }

    /// True when a row exceeds its load by another factor than usual first.
    pub fn states_overload(&self) -> bool {
        match self {
            Self::Schemes(_) => false,
            Self::Rows { training, holdout, .. } => {
                training.iter().chain(holdout).any(PlanRow::states_overload)
            }
        }
    }

    /// True when every row names its reference reading.
    pub fn states_reference_record(&self) -> bool {
        match self {
            Self::Schemes(schemes) => schemes.training.in_sequence,
            Self::Rows { training, holdout, .. } => {
                training.iter().chain(holdout).all(|row| row.reference_record.is_some())
            }
        }
    }

    /// A part with the streams of a seed.
    pub fn part(&self, name: PartName, streams: Streams) -> PlanPart<'_> {
        let source = match (self, name) {
            (Self::Schemes(schemes), PartName::Training) => Source::Scheme(&schemes.training),
            (Self::Schemes(schemes), PartName::Holdout) => Source::Scheme(&schemes.holdout),
            (Self::Rows { training, repeats, .. }, PartName::Training) => {
                Source::Rows { rows: training, repeats: *repeats }
            }
            (Self::Rows { holdout, .. }, PartName::Holdout) => Source::Rows { rows: holdout, repeats: 1 },
        };
        PlanPart { name, source, streams }
    }

    /// The same plan with as many drawn training poses.
    ///
    /// # Errors
    /// [`PlanError::ListedPoses`], [`PlanError::Size`].
    pub fn with_poses(mut self, poses: u64) -> Result<Self, PlanError> {
        match &mut self {
            Self::Schemes(schemes) => match &mut schemes.training.poses {
                Poses::Drawn { count, .. } => *count = poses,
                Poses::Listed(_) => return Err(PlanError::ListedPoses),
            },
            Self::Rows { .. } => return Err(PlanError::ListedPoses),
        }
        self.checked()
    }

    /// The same plan with as many readings of each training condition.
    ///
    /// # Errors
    /// [`PlanError::Size`].
    pub fn with_repeats(mut self, wanted: u64) -> Result<Self, PlanError> {
        match &mut self {
            Self::Schemes(schemes) => schemes.training.repeats = wanted,
            Self::Rows { repeats, .. } => *repeats = wanted,
        }
        self.checked()
    }

    /// Refuses to read the rows of a listed sequence more than once.
    pub(super) fn refuse_repeated_order(&self) -> Result<(), Fault> {
        match self {
            Self::Rows { training, repeats, .. }
                if *repeats > 1 && training.iter().any(|row| row.order.is_some()) =>
            {
                let rule = "rows of a listed sequence of loads are read once".to_owned();
                let next = "Remove repeats, or list the repeated rows with their own order.".to_owned();
                Err(Fault::new(FilePlace::file().with_name("repeats"), FileProblem::Rule { rule, next }))
            }
            _ => Ok(()),
        }
    }

    /// The plan if both parts have a possible number of rows; the held-out part may be empty.
    pub(super) fn checked(self) -> Result<Self, PlanError> {
        let rows = |scheme: &Scheme| {
            u128::from(scheme.poses.count()) * scheme.loads.len() as u128 * u128::from(scheme.repeats)
        };
        let [training, holdout] = match &self {
            Self::Schemes(schemes) => [rows(&schemes.training), rows(&schemes.holdout)],
            Self::Rows { training, holdout, repeats, .. } => {
                [training.len() as u128 * u128::from(*repeats), holdout.len() as u128]
            }
        };
        match training.max(holdout) {
            most if training > 0 && most <= u128::from(MOST_ROWS) => Ok(self),
            most => Err(PlanError::Size { rows: if training == 0 { 0 } else { most } }),
        }
    }
}
