//! Names of changes as `--read-as` takes them: `KIND=VALUE`, lengths in mm, angles in degrees.

use std::fmt;
use std::str::FromStr;

use hexbench_core::words::to_digits;
use hexbench_core::{Vector3, Wrench};

use super::change::{
    Change, Group, JointCoordinate, Multiple, ReadingColumn, ReferencePoint, Sensors, Signed, Target,
};
use super::pose::{PoseMistake, PoseOf};
use super::row_order::RowOrder;
use super::turn::{AngleOrder, SignedAxes};
use crate::effects::intern;
use crate::inference::examination::READINGS;

/// Numbers that may have the other sign and are not one column; the kind tells those of one word apart.
const SIGNED: [(&str, Signed); 7] = [
    ("reversed", Signed::Readings),
    ("translations", Signed::Translations),
    ("reversed", Signed::Rotations),
    ("reversed", Signed::Wrench),
    ("forces", Signed::Forces),
    ("reference", Signed::Reference),
    ("reversed", Signed::Moments),
];

/// Groups that are not one column.
const GROUPS: [(&str, Group); 12] = [
    ("translations", Group::Translations),
    ("rotations", Group::Rotations),
    ("readings", Group::Readings),
    ("forces", Group::Forces),
    ("moments", Group::Moments),
    ("loads", Group::Loads),
    ("pose-positions", Group::PosePositions),
    ("pose-angles", Group::PoseAngles),
    ("base-joints", Group::BaseJoints),
    ("platform-joints", Group::PlatformJoints),
    ("joints", Group::Joints),
    ("noise", Group::Noise),
];

const AXES: [char; 3] = ['x', 'y', 'z'];

/// Words of one column each, with what it is of six readings or of six loads.
fn columns<T>(reading: fn(u8) -> T, load: fn(u8) -> T) -> impl Iterator<Item = (&'static str, T)> {
    let readings = READINGS.into_iter().zip((0..).map(reading));
    readings.chain(Wrench::NAMES.into_iter().zip((0..).map(load)))
}

fn signed() -> impl Iterator<Item = (&'static str, Signed)> {
    SIGNED.into_iter().chain(columns(Signed::Reading, Signed::Load))
}

fn groups() -> impl Iterator<Item = (&'static str, Group)> {
    GROUPS.into_iter().chain(columns(Group::Reading, Group::Load))
}

impl Group {
    /// Word for the group.
    pub fn word(self) -> &'static str {
        groups().find(|(_, group)| *group == self).map_or("", |(word, _)| word)
    }

    fn named(word: &str) -> Option<Self> {
        groups().find(|(known, _)| *known == word).map(|(_, group)| group)
    }
}

hexbench_core::worded! {
    /// Word for what is written in axes.
    Target::word {
        Readings => "readings",
        ReadingColumns => "reading-columns",
        TranslationColumns => "translation-columns",
        RotationColumns => "rotation-columns",
        Points => "points",
        Wrench => "wrench",
        WrenchColumns => "wrench-columns",
        ForceColumns => "force-columns",
        MomentColumns => "moment-columns",
        Poses => "poses",
        PosePositionColumns => "pose-position-columns",
        PoseAngleColumns => "pose-angle-columns",
        Joints => "joints",
        BaseJoints => "base-joints",
        PlatformJoints => "platform-joints",
    }
}

hexbench_core::worded! {
    /// Word for what refers to a point.
    ReferencePoint::word {
        MomentsFixed => "moments-fixed",
        MomentsMobile => "moments-mobile",
        ReadingsMobile => "readings-mobile",
        Poses => "poses",
        PlatformJoints => "platform-joints",
    }
}

impl fmt::Display for JointCoordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = if self.platform { "platform" } else { "base" };
        write!(f, "{end}-{}-{}", self.leg + 1, AXES[usize::from(self.axis)])
    }
}

impl fmt::Display for SignedAxes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, axis) in self.axes().into_iter().enumerate() {
            let sign = if axis < 0 { "-" } else { "" };
            let comma = if k > 0 { "," } else { "" };
            write!(f, "{comma}{sign}{}", AXES[usize::from(axis.unsigned_abs()) - 1])?;
        }
        Ok(())
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::Within(lines, multiple) = self {
            let [first, last] = lines.ends();
            return write!(f, "{}{WITHIN}{first}-{last}", multiple.everywhere());
        }
        write!(f, "{}=", self.kind().word())?;
        match self {
            Self::Reversed(signed) => {
                let found = self::signed().find(|(_, known)| known == signed);
                f.write_str(found.map_or("", |(word, _)| word))
            }
            Self::StatesExchanged | Self::JointsExchanged => f.write_str("yes"),
            Self::Scaled(group, factor) => write!(f, "{}*{}", group.word(), short(*factor)),
            Self::Renamed(target, axes) => write!(f, "{}:{axes}", target.word()),
            Self::Turned(target, by) => {
                write!(f, "{}:turned:{}", target.word(), triple(&by.map(f64::to_degrees)))
            }
            Self::LegOrder(order) => f.write_str(&order.map(|k| (k + 1).to_string()).join(",")),
            Self::Origin(origin, at) => write!(f, "{}:{}", origin.word(), triple(&(at * 1e3))),
            Self::Joint(coordinate, off) => write!(f, "{coordinate}:{}", short(off * 1e3)),
            Self::WrenchMobile | Self::DeflectionMobile => f.write_str("mobile"),
            Self::MomentsMobile => f.write_str("moments-mobile"),
            Self::Angles(order) => f.write_str(order.word()),
            Self::PoseAngles(order) => write!(f, "poses:{}", order.word()),
            Self::OtherRotations => f.write_str("other"),
            Self::Preload(load) => f.write_str(&load.to_array().map(short).join(",")),
            Self::LoadIsChange => f.write_str("change"),
            Self::LoadHoldsReference => f.write_str("twice"),
            Self::Rows(order) => f.write_str(order.word()),
            Self::SensorReversed(which) => write!(f, "{which}"),
            Self::SensorScaled(which, factor) => write!(f, "{which}*{}", short(*factor)),
            Self::SensorMoved(name, by) => write!(f, "{name}:{}", triple(&(by * 1e3))),
            Self::SensorTurned(name, by) => write!(f, "{name}:turned:{}", triple(&by.map(f64::to_degrees))),
            Self::SensorsExchanged(one, other) => write!(f, "{one},{other}"),
            Self::ZeroError(column, error) => write!(f, "{column}:{}", short(error * 1e6)),
            Self::Pose(_, mistake) => write!(f, "{mistake}"),
            Self::Within(..) => Ok(()),
        }
    }
}

/// What stands between a sign, a unit or an axis and the lines of the file to which it is limited.
const WITHIN: char = '@';
/// What stands before the kind of sensor where all of them are meant.
const ALL: &str = "all:";

impl fmt::Display for ReadingColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pose(k) => f.write_str(READINGS[usize::from(*k)]),
            Self::Sensor(name) => f.write_str(name),
        }
    }
}

impl ReadingColumn {
    fn parsed(text: &str) -> Option<Self> {
        let pose = READINGS.iter().zip(0..).find(|(name, _)| **name == text);
        let sensor = || (!text.is_empty()).then(|| Self::Sensor(intern::text(text)));
        pose.map(|(_, k)| Self::Pose(k)).or_else(sensor)
    }
}

impl fmt::Display for Sensors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::One(name) => f.write_str(name),
            Self::All(kind) => write!(f, "{ALL}{kind}"),
        }
    }
}

impl Sensors {
    fn parsed(text: &str) -> Option<Self> {
        let word = |text: &str| (!text.is_empty()).then(|| intern::text(text));
        match text.strip_prefix(ALL) {
            Some(kind) => word(kind).map(Self::All),
            None => word(text).map(Self::One),
        }
    }
}

/// Names of changes, in their order.
pub fn names(changes: &[Change]) -> Vec<String> {
    changes.iter().map(ToString::to_string).collect()
}

/// A number with the digits that matter.
pub(super) fn short(x: f64) -> String {
    let text = to_digits(x, 7).to_string();
    if text.len() > 12 { format!("{x:.5e}") } else { text }
}

fn triple(v: &Vector3) -> String {
    [short(v.x), short(v.y), short(v.z)].join(",")
}

/// A change that `--read-as` does not know.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChangeError {
    /// Not `KIND=VALUE`.
    #[error("{0:?} is not KIND=VALUE, as in deflection-sign=reversed")]
    Form(String),
    /// A kind that nothing is read by.
    #[error("{0:?} is not a known kind of misstatement; known: {kinds}", kinds = KINDS.map(|(kind, _)| kind).join(", "))]
    Kind(String),
    /// A value that the kind does not take.
    #[error("{kind} does not take {value:?}; it takes {takes}")]
    Value {
        /// The kind.
        kind: &'static str,
        /// What was asked of it.
        value: String,
        /// What it takes.
        takes: &'static str,
    },
}

/// Kinds by which a file may be read, with what they take.
pub const KINDS: [(&str, &str); 24] = [
    (
        "deflection-sign",
        "reversed, translations, da, db or dc; every sign and unit, and columns in other axes, with a range of lines for part of a file, as in da@126-253",
    ),
    ("rotation-sign", "reversed, dalpha, dbeta or dgamma"),
    ("wrench-sign", "reversed, forces, reference, fx, fy or fz"),
    ("moment-sign", "reversed, mx, my or mz"),
    ("states-exchanged", "yes"),
    (
        "unit",
        "GROUP*FACTOR; groups: translations, rotations, readings, forces, moments, loads, pose-positions, pose-angles, base-joints, \
         platform-joints, joints, noise, or one column: da to dgamma, fx to mz",
    ),
    (
        "axes",
        "WHAT:AXES as in readings:y,-x,z, or WHAT:turned:RX,RY,RZ in degrees; what: readings, reading-columns, translation-columns, rotation-columns, points, \
         wrench, wrench-columns, force-columns, moment-columns, poses, pose-position-columns, pose-angle-columns, joints, base-joints, platform-joints, or with turned a sensor",
    ),
    ("leg-order", "the six platform joints in their order, as in 2,3,4,5,6,1"),
    ("joints-exchanged", "yes"),
    (
        "origin",
        "WHAT:X,Y,Z in mm; what: moments-fixed, moments-mobile, readings-mobile, poses, platform-joints",
    ),
    ("geometry", "JOINT:MM as in base-2-y:-1.5"),
    ("wrench-frame", "mobile or moments-mobile"),
    ("deflection-frame", "mobile"),
    (
        "angle-convention",
        "moving-x-y-z, fixed-x-z-y, fixed-y-x-z, fixed-y-z-x, fixed-z-x-y, rotation-vector or inverse; prefixed with poses: for the \
         poses only",
    ),
    ("rotation-convention", "other"),
    (
        "reference-missing",
        "change, twice, or the load of the reference state: FX,FY,FZ,MX,MY,MZ in N and N m",
    ),
    (
        "row-order",
        "loads-from-below, loads-from-above, loads-reversed, load-of-the-next, load-of-the-last, poses-from-below, poses-from-above, \
         readings-from-below, readings-from-above or readings-reversed",
    ),
    ("sensor-sign", "a sensor or one number of it, as in ball_x, or all:KIND as in all:distance"),
    ("sensor-factor", "SENSOR*FACTOR as in g1*25.4, or all:KIND*FACTOR"),
    ("sensor-place", "SENSOR:X,Y,Z, the displacement of its point in mm"),
    ("sensors-exchanged", "the two sensors, as in g1,g2"),
    ("zero-error", "COLUMN:ERROR in um or urad, as in da:5 or g1:-2.5"),
    (PoseOf::Instrument.kind(), POSE_TAKES),
    (PoseOf::Command.kind(), POSE_TAKES),
];

/// What a pose is read by.
const POSE_TAKES: &str = "-NUMBERS or NUMBERS*FACTOR; numbers: positions, angles, a, b, c, alpha, beta or gamma; positions:AXES or angles:AXES as \
     in positions:y,x,z; left-handed, inverse, or a word of angle-convention";

impl FromStr for Change {
    type Err = ChangeError;

    fn from_str(text: &str) -> Result<Self, ChangeError> {
        let (kind, given) = text.split_once('=').ok_or_else(|| ChangeError::Form(text.to_owned()))?;
        let known = KINDS.iter().find(|(known, _)| *known == kind);
        let (kind, takes) = *known.ok_or_else(|| ChangeError::Kind(kind.to_owned()))?;
        let change = match given.rsplit_once(WITHIN) {
            Some((what, lines)) => within(kind, what, lines),
            None => parsed(kind, given),
        };
        change.ok_or_else(|| ChangeError::Value { kind, value: given.to_owned(), takes })
    }
}

/// A sign, a unit or an axis of some lines only.
fn within(kind: &str, what: &str, lines: &str) -> Option<Change> {
    let multiple = Multiple::of(parsed(kind, what)?)?;
    Some(Change::Within(lines.parse().ok()?, multiple))
}

fn parsed(kind: &str, given: &str) -> Option<Change> {
    let yes = |change: Change| (given == "yes").then_some(change);
    let mobile = |change: Change| (given == "mobile").then_some(change);
    match kind {
        "states-exchanged" => yes(Change::StatesExchanged),
        "joints-exchanged" => yes(Change::JointsExchanged),
        "wrench-frame" if given == "moments-mobile" => Some(Change::MomentsMobile),
        "wrench-frame" => mobile(Change::WrenchMobile),
        "deflection-frame" => mobile(Change::DeflectionMobile),
        "rotation-convention" => (given == "other").then_some(Change::OtherRotations),
        "unit" => {
            let (group, factor) = scaled(given)?;
            Some(Change::Scaled(Group::named(group)?, factor))
        }
        "axes" => {
            let (target, axes) = given.split_once(':')?;
            let by = |text| numbers(text).map(|by| Vector3::from(by).map(f64::to_radians));
            match (Target::named(target), axes.strip_prefix("turned:")) {
                (Some(target), Some(text)) => Some(Change::Turned(target, by(text)?)),
                (Some(target), None) => Some(Change::Renamed(target, signed_axes(axes)?)),
                (None, Some(text)) => Some(Change::SensorTurned(intern::text(target), by(text)?)),
                (None, None) => None,
            }
        }
        "leg-order" => leg_order(given).map(Change::LegOrder),
        "origin" => {
            let (origin, at) = given.split_once(':')?;
            Some(Change::Origin(ReferencePoint::named(origin)?, Vector3::from(numbers(at)?) * 1e-3))
        }
        "geometry" => {
            let (joint, off) = given.split_once(':')?;
            let coordinate = JointCoordinate::all().find(|c| c.to_string() == joint)?;
            let [off] = numbers(off)?;
            Some(Change::Joint(coordinate, off * 1e-3))
        }
        "angle-convention" => match given.strip_prefix("poses:") {
            Some(rest) => AngleOrder::named(rest).map(Change::PoseAngles),
            None => AngleOrder::named(given).map(Change::Angles),
        },
        "reference-missing" if given == "change" => Some(Change::LoadIsChange),
        "reference-missing" if given == "twice" => Some(Change::LoadHoldsReference),
        "reference-missing" => numbers(given).map(|w| Change::Preload(Wrench::from_array(w))),
        "zero-error" => {
            let (column, error) = given.split_once(':')?;
            let [error] = numbers(error)?;
            Some(Change::ZeroError(ReadingColumn::parsed(column)?, error * 1e-6))
        }
        "measured-pose" => pose(PoseOf::Instrument, given),
        "commanded-pose" => pose(PoseOf::Command, given),
        "row-order" => RowOrder::named(given).map(Change::Rows),
        _ => of_sensors(kind, given).or_else(|| reversed(kind, given)),
    }
}

fn of_sensors(kind: &str, given: &str) -> Option<Change> {
    match kind {
        "sensor-sign" => Sensors::parsed(given).map(Change::SensorReversed),
        "sensor-factor" => {
            let (which, factor) = scaled(given)?;
            Some(Change::SensorScaled(Sensors::parsed(which)?, factor))
        }
        "sensor-place" => {
            let (name, by) = given.split_once(':')?;
            Some(Change::SensorMoved(intern::text(name), Vector3::from(numbers(by)?) * 1e-3))
        }
        "sensors-exchanged" => {
            let (one, other) = given.split_once(',')?;
            Some(Change::SensorsExchanged(intern::text(one), intern::text(other)))
        }
        _ => None,
    }
}

fn reversed(kind: &str, given: &str) -> Option<Change> {
    let mut named = signed().filter(|(word, _)| *word == given).map(|(_, signed)| Change::Reversed(signed));
    named.find(|change| change.kind().word() == kind)
}

/// What stands before a factor, and the factor.
pub(super) fn scaled(given: &str) -> Option<(&str, f64)> {
    let (what, factor) = given.split_once('*')?;
    let factor: f64 = factor.parse().ok()?;
    (factor.is_finite() && factor > 0.0).then_some((what, factor))
}

fn pose(of: PoseOf, given: &str) -> Option<Change> {
    PoseMistake::parsed(given, signed_axes).map(|mistake| Change::Pose(of, mistake))
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Vec<f64> = text.split(',').map(|x| x.trim().parse().ok()).collect::<Option<_>>()?;
    let all: [f64; N] = all.try_into().ok()?;
    all.iter().all(|x| x.is_finite()).then_some(all)
}

fn signed_axes(text: &str) -> Option<SignedAxes> {
    let axis = |text: &str| {
        let (sign, name) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
        let at = AXES.iter().position(|a| name == a.to_string())?;
        Some(sign * (i8::try_from(at).ok()? + 1))
    };
    let all: Vec<i8> = text.split(',').map(axis).collect::<Option<_>>()?;
    SignedAxes::new(all.try_into().ok()?)
}

fn leg_order(text: &str) -> Option<[u8; 6]> {
    let leg = |text: &str| text.parse::<u8>().ok()?.checked_sub(1);
    let order: [u8; 6] = text.split(',').map(leg).collect::<Option<Vec<_>>>()?.try_into().ok()?;
    let mut sorted = order;
    sorted.sort_unstable();
    (sorted == [0, 1, 2, 3, 4, 5]).then_some(order)
}
