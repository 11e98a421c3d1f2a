//! What the readings say of themselves: faults of the data, told beside any verdict on the machine.

use serde::{Deserialize, Serialize};

use crate::inference::misread::Change;

/// Kind of a fault of the data; the words are those of `diagnosis.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum FindingKind {
    /// A number or a row that no reading can have given.
    Blunder,
    /// A commanded pose that is not the one measured at.
    Pose,
    /// A load that is not the one applied.
    Load,
    /// More readings that others contradict than a record gets wrong by itself.
    Contradiction,
    /// The same, where neither springs nor any effect come near the readings.
    Inconsistent,
    /// Readings scatter more or less than stated.
    NoiseLevel,
    /// Readings scatter with more large errors than a Gaussian has.
    HeavyTails,
    /// Readings are differences from one reference reading.
    SharedReference,
    /// Readings share the errors of their references, as the file says.
    ReferenceRecord,
    /// Repeats of a condition share an error of the set-up.
    SetupError,
    /// Loads scatter about what the file states.
    LoadNoise,
    /// Errors of neighboring rows resemble each other.
    Drift,
    /// Readings are rounded to a step larger than their noise.
    Resolution,
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
    /// A column that holds one number in all rows, or the numbers of another column.
    IdleColumn,
    /// Rows that are copies of others.
    Copies,
    /// A file of readings held out that does not serve as one.
    Holdout,
    /// A sensor that reads with the other sign.
    SensorSign,
    /// A sensor whose numbers are in another unit than stated.
    SensorFactor,
    /// A sensor that stands elsewhere or looks in another direction.
    SensorPlace,
    /// A sensor that shows a little too much or too little.
    SensorGain,
    /// Sensors whose numbers stand in each other's columns.
    SensorsExchanged,
    /// A column of readings that is off by the same amount in every row.
    ZeroError,
    /// Readings that fall short of the motion by the same amount.
    DeadBand,
    /// Measured poses with another sign, in another unit, in other axes.
    MeasuredPose,
    /// Commanded poses likewise.
    CommandedPose,
}

/// What a fault of the data concerns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Concern {
    /// Single readings.
    Readings,
    /// More readings than can be left out.
    ManyReadings,
    /// Conditions as a whole, as an effect of the machine does.
    Conditions,
    /// Conditions, of which the readings are left out.
    WrongConditions,
    /// What the file says itself of the noise of all readings.
    AsStated,
    /// The noise of all readings.
    Noise,
    /// The noise of conditions as a whole.
    NoiseOfConditions,
    /// What the file as a whole means.
    File,
    /// The readings held out.
    Holdout,
}

impl FindingKind {
    /// Word of the files, a few words, capitalized, and what it concerns.
    fn entry(self) -> (&'static str, &'static str, Concern) {
        match self {
            Self::Blunder => ("blunder", "Blunder", Concern::Readings),
            Self::Pose => ("pose", "Wrong pose", Concern::WrongConditions),
            Self::Load => ("load", "Wrong load", Concern::WrongConditions),
            Self::Contradiction => ("contradiction", "Contradiction", Concern::ManyReadings),
            Self::Inconsistent => ("inconsistent", "Inconsistent readings", Concern::File),
            Self::NoiseLevel => ("noise-level", "Noise level", Concern::Noise),
            Self::HeavyTails => ("heavy-tails", "Heavy tails", Concern::Noise),
            Self::SharedReference => ("shared-reference", "Shared reference", Concern::Noise),
            Self::ReferenceRecord => ("reference-record", "Reference records", Concern::AsStated),
            Self::SetupError => ("setup-error", "Setup error", Concern::NoiseOfConditions),
            Self::LoadNoise => ("load-noise", "Noise of the loads", Concern::NoiseOfConditions),
            Self::Drift => ("drift", "Drift", Concern::Noise),
            Self::Resolution => ("resolution", "Resolution", Concern::Noise),
            Self::Tolerance => ("tolerance", "Tolerance", Concern::Conditions),
            Self::DeflectionSign => ("deflection-sign", "Sign of the deflections", Concern::File),
            Self::WrenchSign => ("wrench-sign", "Sign of the loads", Concern::File),
            Self::StatesExchanged => {
                ("states-exchanged", "Loaded and reference state exchanged", Concern::File)
            }
            Self::RotationSign => ("rotation-sign", "Sign of the rotations", Concern::File),
            Self::MomentSign => ("moment-sign", "Sign of the moments", Concern::File),
            Self::Unit => ("unit", "Unit", Concern::File),
            Self::Axes => ("axes", "Axes", Concern::File),
            Self::LegOrder => ("leg-order", "Order of the legs", Concern::File),
            Self::JointsExchanged => ("joints-exchanged", "Base and platform exchanged", Concern::File),
            Self::Origin => ("origin", "Point of reference", Concern::File),
            Self::Geometry => ("geometry", "Position of a joint", Concern::File),
            Self::WrenchFrame => ("wrench-frame", "Frame of the loads", Concern::File),
            Self::DeflectionFrame => ("deflection-frame", "Frame of the deflections", Concern::File),
            Self::AngleConvention => ("angle-convention", "Convention of the angles", Concern::File),
            Self::RotationConvention => ("rotation-convention", "Convention of the rotations", Concern::File),
            Self::ReferenceMissing => ("reference-missing", "Reference load missing", Concern::File),
            Self::RowOrder => ("row-order", "Order of the rows", Concern::File),
            Self::SensorSign => ("sensor-sign", "Sign of a sensor", Concern::File),
            Self::SensorFactor => ("sensor-factor", "Factor of a sensor", Concern::File),
            Self::SensorPlace => ("sensor-place", "Position of a sensor", Concern::Conditions),
            Self::SensorGain => ("sensor-gain", "Gain of a sensor", Concern::Conditions),
            Self::SensorsExchanged => ("sensors-exchanged", "Sensors exchanged", Concern::File),
            Self::ZeroError => ("zero-error", "Zero error", Concern::File),
            Self::DeadBand => ("dead-band", "Dead band", Concern::Conditions),
            Self::MeasuredPose => ("measured-pose", "Measured poses", Concern::File),
            Self::CommandedPose => ("commanded-pose", "Commanded poses", Concern::File),
            Self::IdleColumn => ("idle-column", "Idle column", Concern::File),
            Self::Copies => ("copies", "Copied rows", Concern::Readings),
            Self::Holdout => ("holdout", "Holdout file", Concern::Holdout),
        }
    }

    /// True for faults that concern a condition as a whole, as an effect of the machine does.
    pub fn is_of_conditions(self) -> bool {
        matches!(self.entry().2, Concern::Conditions | Concern::WrongConditions | Concern::NoiseOfConditions)
    }

    /// True for statements about the noise.
    pub fn is_of_noise(self) -> bool {
        matches!(self.entry().2, Concern::Noise | Concern::NoiseOfConditions | Concern::AsStated)
    }

    /// True for what the file says itself of the noise.
    fn is_as_stated(self) -> bool {
        self.entry().2 == Concern::AsStated
    }

    /// True when the file as a whole does not say what its author meant: nothing follows for the machine until it does.
    pub fn is_of_file(self) -> bool {
        self.entry().2 == Concern::File
    }

    /// A few words, capitalized.
    pub fn title(self) -> &'static str {
        self.entry().1
    }

    /// The word of the files.
    pub fn word(self) -> &'static str {
        self.entry().0
    }
}

/// One fault of the data.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Finding {
    /// What is wrong.
    pub kind: FindingKind,
    /// Probability against readings as stated, and against physics without a name.
    pub probability: f64,
    /// Lines of the file; empty for a statement about all of them.
    pub rows: Vec<u64>,
    /// How large, with its unit.
    pub size: String,
    /// A sentence.
    pub text: String,
    /// What to do.
    pub next: String,
    /// How the file may be read instead: changes in their order; none where the finding is about something else. In files `next` says it.
    #[serde(skip)]
    pub read_as: Vec<Change>,
    /// True for errors of inputs that are within what their tolerances make likely: shown by the readings, and no fault.
    #[serde(skip)]
    pub is_within_tolerance: bool,
}

impl Finding {
    /// One that is sure and about no line, without words.
    pub(crate) fn of(kind: FindingKind) -> Self {
        let text = String::new;
        let (size, text, next) = (text(), text(), text());
        let (rows, read_as) = (Vec::new(), Vec::new());
        Self { kind, probability: 1.0, rows, size, text, next, read_as, is_within_tolerance: false }
    }

    /// A contradiction in a file of which nothing explains the rest either: the readings are at fault, and not the machine.
    pub(crate) fn nothing_explains(self) -> Self {
        if self.kind != FindingKind::Contradiction {
            return self;
        }
        let text = format!("{}, and nothing explains the file to within tens of times its noise", self.text);
        Self { kind: FindingKind::Inconsistent, text, ..self }
    }

    /// True for what is told of the data and is no fault of them.
    pub fn is_as_stated(&self) -> bool {
        self.kind.is_as_stated() || self.is_within_tolerance
    }

    /// True when the readings of its rows took no part in the fit.
    pub fn excludes(&self) -> bool {
        matches!(self.kind.entry().2, Concern::Readings | Concern::WrongConditions)
    }
}

/// True when the files do not seem to mean what they say.
pub fn is_misread(findings: &[Finding]) -> bool {
    findings.iter().any(|finding| finding.kind.is_of_file())
}

/// Probability from a difference of log-evidences.
pub(super) fn probability(nats: f64) -> f64 {
    1.0 / (1.0 + (-nats).exp())
}

#[cfg(test)]
mod tests {
    use super::FindingKind::{
        Blunder, Contradiction, Holdout, Load, ReferenceRecord, SetupError, Tolerance, Unit,
    };
    use super::*;

    fn finding(kind: FindingKind) -> Finding {
        let text = || "lines 2 and 3".to_owned();
        let rows = vec![2, 3];
        Finding { rows, size: text(), text: text(), next: text(), ..Finding::of(kind) }
    }

    #[test]
    fn a_fault_concerns_readings_conditions_the_noise_or_the_file() {
        for (kind, conditions, noise, stated, file, excludes) in [
            (Blunder, false, false, false, false, true),
            (Load, true, false, false, false, true),
            (Tolerance, true, false, false, false, false),
            (SetupError, true, true, false, false, false),
            (ReferenceRecord, false, true, true, false, false),
            (Unit, false, false, false, true, false),
            (Holdout, false, false, false, false, false),
        ] {
            let found = [kind.is_of_conditions(), kind.is_of_noise(), kind.is_as_stated(), kind.is_of_file()];
            assert_eq!(found, [conditions, noise, stated, file], "{kind:?}");
            let found = finding(kind);
            assert_eq!(found.excludes(), excludes, "{kind:?}");
            assert_eq!(is_misread(&[finding(Blunder), found]), file, "{kind:?}");
        }
        assert!((probability(3.0) - 0.952_574).abs() < 1e-6);
    }

    #[test]
    fn a_contradiction_that_nothing_explains_is_inconsistent() {
        assert_eq!(finding(Contradiction).nothing_explains().kind, FindingKind::Inconsistent);
        assert_eq!(finding(Blunder).nothing_explains(), finding(Blunder));
    }
}
