//! What the readings say of themselves: faults of the data, told beside any verdict on the machine.

use serde::Serialize;

/// Kind of a fault of the data; the words are those of `diagnosis.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum FindingKind {
    /// A number or a row that no reading can have given.
    Blunder,
    /// A commanded pose that is not the one measured at.
    Pose,
    /// A load that is not the one applied.
    Load,
    /// Readings scatter more or less than stated.
    NoiseLevel,
    /// Readings scatter with more large errors than a Gaussian has.
    HeavyTails,
    /// Readings are differences from one reference reading.
    SharedReference,
    /// Repeats of a condition share an error of the set-up.
    SetupError,
    /// Errors of neighboring rows resemble each other.
    Drift,
    /// Readings are rounded to a step larger than their noise.
    Resolution,
    /// Joints are not where the drawing has them.
    Tolerance,
}

impl FindingKind {
    /// True for faults that concern a condition as a whole, as an effect of the machine does.
    pub fn is_of_conditions(self) -> bool {
        matches!(self, Self::Pose | Self::Load | Self::SetupError | Self::Tolerance)
    }

    /// True for statements about the noise.
    pub fn is_of_noise(self) -> bool {
        match self {
            Self::NoiseLevel
            | Self::HeavyTails
            | Self::SharedReference
            | Self::SetupError
            | Self::Drift
            | Self::Resolution => true,
            Self::Blunder | Self::Pose | Self::Load | Self::Tolerance => false,
        }
    }

    /// A few words, capitalized.
    pub fn title(self) -> &'static str {
        match self {
            Self::Blunder => "Blunder",
            Self::Pose => "Wrong pose",
            Self::Load => "Wrong load",
            Self::NoiseLevel => "Noise level",
            Self::HeavyTails => "Heavy tails",
            Self::SharedReference => "Shared reference",
            Self::SetupError => "Set-up error",
            Self::Drift => "Drift",
            Self::Resolution => "Resolution",
            Self::Tolerance => "Tolerance",
        }
    }
}

/// One fault of the data.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Finding {
    /// What is wrong.
    pub kind: FindingKind,
    /// Probability against readings as stated.
    pub probability: f64,
    /// Lines of the file; empty for a statement about all of them.
    pub rows: Vec<u64>,
    /// How large, with its unit.
    pub size: String,
    /// A sentence.
    pub text: String,
    /// What to do.
    pub next: String,
}

impl Finding {
    /// True when the readings of its rows took no part in the fit.
    pub fn excludes(&self) -> bool {
        matches!(self.kind, FindingKind::Blunder | FindingKind::Pose | FindingKind::Load)
    }
}

/// Probability from a difference of log-evidences.
pub(super) fn probability(nats: f64) -> f64 {
    1.0 / (1.0 + (-nats).exp())
}
