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
    /// Joints are not where the drawing has them.
    Tolerance,
    /// Deflections, or translations, with the other sign.
    DeflectionSign,
    /// Loads, or forces, with the other sign.
    WrenchSign,
    /// Loaded and reference state exchanged.
    StatesExchanged,
    /// Rotations with the other sign.
    RotationSign,
    /// Moments with the other sign.
    MomentSign,
    /// Numbers in another unit than stated.
    Unit,
    /// Numbers in other axes than stated.
    Axes,
    /// Joints of base and platform that do not belong to the same leg.
    LegOrder,
    /// Base joints given as platform joints, and the other way round.
    JointsExchanged,
    /// Moments, deflections, poses or joints that refer to another point.
    Origin,
    /// A joint that is not where the file has it.
    Geometry,
    /// Loads in the axes of the platform.
    WrenchFrame,
    /// Deflections in the axes of the platform.
    DeflectionFrame,
    /// Angles that turn in another order.
    AngleConvention,
    /// Differences of angles given as a rotation vector, or the other way round.
    RotationConvention,
    /// The load of the reference state is not in the file.
    ReferenceMissing,
    /// Columns whose rows do not belong together.
    RowOrder,
    /// Rows that are copies of others.
    Copies,
    /// A file of readings held out that does not serve as one.
    Holdout,
}

impl FindingKind {
    /// True for faults that concern a condition as a whole, as an effect of the machine does.
    pub fn is_of_conditions(self) -> bool {
        matches!(self, Self::Pose | Self::Load | Self::SetupError | Self::Tolerance)
    }

    /// True for statements about the noise.
    pub fn is_of_noise(self) -> bool {
        matches!(
            self,
            Self::NoiseLevel | Self::HeavyTails | Self::SharedReference | Self::SetupError | Self::Drift
        )
    }

    /// True when the file as a whole does not say what its author meant: nothing follows for the machine until it does.
    pub fn is_of_file(self) -> bool {
        match self {
            Self::DeflectionSign
            | Self::WrenchSign
            | Self::StatesExchanged
            | Self::RotationSign
            | Self::MomentSign
            | Self::Unit
            | Self::Axes
            | Self::LegOrder
            | Self::JointsExchanged
            | Self::Origin
            | Self::Geometry
            | Self::WrenchFrame
            | Self::DeflectionFrame
            | Self::AngleConvention
            | Self::RotationConvention
            | Self::ReferenceMissing
            | Self::RowOrder => true,
            Self::Blunder
            | Self::Pose
            | Self::Load
            | Self::NoiseLevel
            | Self::HeavyTails
            | Self::SharedReference
            | Self::SetupError
            | Self::Drift
            | Self::Tolerance
            | Self::Copies
            | Self::Holdout => false,
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
            Self::Tolerance => "Tolerance",
            Self::DeflectionSign => "Sign of the deflections",
            Self::WrenchSign => "Sign of the loads",
            Self::StatesExchanged => "Loaded and reference state exchanged",
            Self::RotationSign => "Sign of the rotations",
            Self::MomentSign => "Sign of the moments",
            Self::Unit => "Unit",
            Self::Axes => "Axes",
            Self::LegOrder => "Order of the legs",
            Self::JointsExchanged => "Base and platform exchanged",
            Self::Origin => "Point of reference",
            Self::Geometry => "Position of a joint",
            Self::WrenchFrame => "Frame of the loads",
            Self::DeflectionFrame => "Frame of the deflections",
            Self::AngleConvention => "Convention of the angles",
            Self::RotationConvention => "Convention of the rotations",
            Self::ReferenceMissing => "Reference load missing",
            Self::RowOrder => "Order of the rows",
            Self::Copies => "Copied rows",
            Self::Holdout => "Held-out file",
        }
    }

    /// The word of the files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Blunder => "blunder",
            Self::Pose => "pose",
            Self::Load => "load",
            Self::NoiseLevel => "noise-level",
            Self::HeavyTails => "heavy-tails",
            Self::SharedReference => "shared-reference",
            Self::SetupError => "setup-error",
            Self::Drift => "drift",
            Self::Tolerance => "tolerance",
            Self::DeflectionSign => "deflection-sign",
            Self::WrenchSign => "wrench-sign",
            Self::StatesExchanged => "states-exchanged",
            Self::RotationSign => "rotation-sign",
            Self::MomentSign => "moment-sign",
            Self::Unit => "unit",
            Self::Axes => "axes",
            Self::LegOrder => "leg-order",
            Self::JointsExchanged => "joints-exchanged",
            Self::Origin => "origin",
            Self::Geometry => "geometry",
            Self::WrenchFrame => "wrench-frame",
            Self::DeflectionFrame => "deflection-frame",
            Self::AngleConvention => "angle-convention",
            Self::RotationConvention => "rotation-convention",
            Self::ReferenceMissing => "reference-missing",
            Self::RowOrder => "row-order",
            Self::Copies => "copies",
            Self::Holdout => "holdout",
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
        matches!(
            self.kind,
            FindingKind::Blunder | FindingKind::Pose | FindingKind::Load | FindingKind::Copies
        )
    }
}

/// Probability from a difference of log-evidences.
pub(super) fn probability(nats: f64) -> f64 {
    1.0 / (1.0 + (-nats).exp())
}
