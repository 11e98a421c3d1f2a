//! Names of changes as `--read-as` takes them: `KIND=VALUE`, lengths in mm, angles in degrees.

use std::fmt;
use std::str::FromStr;

use hexbench_core::{Vector3, Wrench};

use super::change::{
    Change, Group, JointCoordinate, Multiple, ReadingColumn, ReferencePoint, Sensors, Signed, Target,
};
use super::pose::{PoseMistake, PoseOf};
use super::row_order::RowOrder;
use super::turn::{AngleOrder, SignedAxes};
use crate::effects::intern;
use crate::inference::examination::READINGS;
use crate::results::words::significant;

const SIGNED: [(&str, &str, Signed); 19] = [
    ("deflection-sign", "reversed", Signed::Readings),
    ("deflection-sign", "translations", Signed::Translations),
    ("deflection-sign", "da", Signed::Reading(0)),
    ("deflection-sign", "db", Signed::Reading(1)),
    ("deflection-sign", "dc", Signed::Reading(2)),
    ("rotation-sign", "reversed", Signed::Rotations),
    ("rotation-sign", "dalpha", Signed::Reading(3)),
    ("rotation-sign", "dbeta", Signed::Reading(4)),
    ("rotation-sign", "dgamma", Signed::Reading(5)),
    ("wrench-sign", "reversed", Signed::Wrench),
    ("wrench-sign", "forces", Signed::Forces),
    ("wrench-sign", "reference", Signed::Reference),
    ("wrench-sign", "fx", Signed::Load(0)),
    ("wrench-sign", "fy", Signed::Load(1)),
    ("wrench-sign", "fz", Signed::Load(2)),
    ("moment-sign", "reversed", Signed::Moments),
    ("moment-sign", "mx", Signed::Load(3)),
    ("moment-sign", "my", Signed::Load(4)),
    ("moment-sign", "mz", Signed::Load(5)),
];

const GROUPS: [(&str, Group); 24] = [
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
    ("da", Group::Reading(0)),
    ("db", Group::Reading(1)),
    ("dc", Group::Reading(2)),
    ("dalpha", Group::Reading(3)),
    ("dbeta", Group::Reading(4)),
    ("dgamma", Group::Reading(5)),
    ("fx", Group::Load(0)),
    ("fy", Group::Load(1)),
    ("fz", Group::Load(2)),
    ("mx", Group::Load(3)),
    ("my", Group::Load(4)),
    ("mz", Group::Load(5)),
];

const TARGETS: [(&str, Target); 15] = [
    ("readings", Target::Readings),
    ("reading-columns", Target::ReadingColumns),
    ("translation-columns", Target::TranslationColumns),
    ("rotation-columns", Target::RotationColumns),
    ("points", Target::Points),
    ("wrench", Target::Wrench),
    ("wrench-columns", Target::WrenchColumns),
    ("force-columns", Target::ForceColumns),
    ("moment-columns", Target::MomentColumns),
    ("poses", Target::Poses),
    ("pose-position-columns", Target::PosePositionColumns),
    ("pose-angle-columns", Target::PoseAngleColumns),
    ("joints", Target::Joints),
    ("base-joints", Target::BaseJoints),
    ("platform-joints", Target::PlatformJoints),
];

const ORIGINS: [(&str, ReferencePoint); 5] = [
    ("moments-fixed", ReferencePoint::MomentsFixed),
    ("moments-mobile", ReferencePoint::MomentsMobile),
    ("readings-mobile", ReferencePoint::ReadingsMobile),
    ("poses", ReferencePoint::Poses),
    ("platform-joints", ReferencePoint::PlatformJoints),
];

const AXES: [char; 3] = ['x', 'y', 'z'];

/// Word of a variant in its table.
fn word<T: PartialEq + Copy>(table: &[(&'static str, T)], value: T) -> &'static str {
    table.iter().find(|(_, v)| *v == value).map_or("", |(word, _)| word)
}

fn value<T: Copy>(table: &[(&str, T)], word: &str) -> Option<T> {
    table.iter().find(|(w, _)| *w == word).map(|(_, v)| *v)
}

impl Group {
    /// Word for the group.
    pub fn word(self) -> &'static str {
        word(&GROUPS, self)
    }
}

impl Target {
    /// Word for what is written in axes.
    pub fn word(self) -> &'static str {
        word(&TARGETS, self)
    }
}

impl ReferencePoint {
    /// Word for what refers to a point.
    pub fn word(self) -> &'static str {
        word(&ORIGINS, self)
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
                let found = SIGNED.iter().find(|(_, _, s)| s == signed);
                f.write_str(found.map_or("", |(_, word, _)| word))
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
    let text = significant(x, 7).to_string();
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
            let (group, factor) = given.split_once('*')?;
            let factor: f64 = factor.parse().ok()?;
            (factor.is_finite() && factor > 0.0).then_some(Change::Scaled(value(&GROUPS, group)?, factor))
        }
        "axes" => {
            let (target, axes) = given.split_once(':')?;
            let by = |text| numbers(text).map(|by| Vector3::from(by).map(f64::to_radians));
            match (value(&TARGETS, target), axes.strip_prefix("turned:")) {
                (Some(target), Some(text)) => Some(Change::Turned(target, by(text)?)),
                (Some(target), None) => Some(Change::Renamed(target, signed_axes(axes)?)),
                (None, Some(text)) => Some(Change::SensorTurned(intern::text(target), by(text)?)),
                (None, None) => None,
            }
        }
        "leg-order" => leg_order(given).map(Change::LegOrder),
        "origin" => {
            let (origin, at) = given.split_once(':')?;
            Some(Change::Origin(value(&ORIGINS, origin)?, Vector3::from(numbers(at)?) * 1e-3))
        }
        "geometry" => {
            let (joint, off) = given.split_once(':')?;
            let coordinate = JointCoordinate::all().find(|c| c.to_string() == joint)?;
            let [off] = numbers(off)?;
            Some(Change::Joint(coordinate, off * 1e-3))
        }
        "angle-convention" => {
            let order = |word: &str| AngleOrder::ALL.into_iter().find(|o| o.word() == word);
            match given.strip_prefix("poses:") {
                Some(rest) => order(rest).map(Change::PoseAngles),
                None => order(given).map(Change::Angles),
            }
        }
        "reference-missing" if given == "change" => Some(Change::LoadIsChange),
        "reference-missing" if given == "twice" => Some(Change::LoadHoldsReference),
        "reference-missing" => numbers(given).map(|w| Change::Preload(Wrench::from_array(w))),
        "sensor-sign" => Sensors::parsed(given).map(Change::SensorReversed),
        "sensor-factor" => {
            let (which, factor) = given.split_once('*')?;
            let factor: f64 = factor.parse().ok()?;
            (factor.is_finite() && factor > 0.0)
                .then_some(Change::SensorScaled(Sensors::parsed(which)?, factor))
        }
        "sensor-place" => {
            let (name, by) = given.split_once(':')?;
            Some(Change::SensorMoved(intern::text(name), Vector3::from(numbers(by)?) * 1e-3))
        }
        "sensors-exchanged" => {
            let (one, other) = given.split_once(',')?;
            Some(Change::SensorsExchanged(intern::text(one), intern::text(other)))
        }
        "zero-error" => {
            let (column, error) = given.split_once(':')?;
            let [error] = numbers(error)?;
            Some(Change::ZeroError(ReadingColumn::parsed(column)?, error * 1e-6))
        }
        "measured-pose" => pose(PoseOf::Instrument, given),
        "commanded-pose" => pose(PoseOf::Command, given),
        "row-order" => RowOrder::ALL.into_iter().find(|o| o.word() == given).map(Change::Rows),
        _ => {
            let known = SIGNED.iter().find(|(k, word, _)| *k == kind && *word == given)?;
            Some(Change::Reversed(known.2))
        }
    }
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
