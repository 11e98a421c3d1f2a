//! A misread file in words.

use std::borrow::Cow;

use hexbench_core::{Vector3, Wrench};

use super::Way;
use super::change::{Change, Group, ReadingColumn, ReferencePoint, Sensors, Signed, Target};
use super::places::{Misplaced, PlacedWay};
use crate::inference::examination::{Finding, READINGS};

/// What explains the file as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AsWritten {
    /// Nothing: the legs do not determine the motion of the platform.
    Nothing,
    /// Only legs of negative stiffness.
    Negative,
    /// The best explanation leaves so many times the noise.
    Level(f64),
    /// The same by effects that leave the stiffness of the legs open.
    Open(f64),
}

/// How a reading of the file did against the file as it is written.
#[derive(Debug, Clone, Copy)]
pub struct AgainstWritten {
    /// As written.
    pub written: AsWritten,
    /// Error over the noise the other way.
    pub other: f64,
}

/// What is reported of a way to read the file. `alike`: the ways that explain the file like it, the best first; `share`: its
/// probability among them.
pub fn finding(way: &Way, alike: &[&Way], answered: AgainstWritten, share: f64) -> Finding {
    let meaning = way.meaning();
    let (size, written) = answered.words();
    let see = to_see(&way.changes);
    let is_first = alike.first().is_none_or(|first| first.changes == way.changes);
    let (text, next) = match (is_first, alike.len()) {
        (true, 0 | 1) => (format!("{meaning}; {written}"), format!("{}; {see}", advice(&way.changes[0]))),
        (true, n) => (
            format!(
                "{meaning}; {written}; {} the file equally well",
                if n == 2 { "the next finding explains" } else { "each of the next findings explains" }
            ),
            format!(
                "the readings alone cannot separate these: check each against the machine, and correct the file; {see}"
            ),
        ),
        (false, _) => (format!("alternatively, {meaning}"), see),
    };
    let read_as = way.changes.clone();
    Finding { probability: share, size, text, next, read_as, ..Finding::of(way.changes[0].kind()) }
}

/// What is reported of poses that no frames carry into each other.
pub fn misplaced_findings(found: &Misplaced) -> Vec<Finding> {
    let share = 1.0 / found.ways.len().max(1) as f64;
    let one = |(k, way): (usize, &PlacedWay)| {
        let changes = &way.changes;
        let (meaning, see) = (meanings(changes), to_see(changes));
        let (left, written) = (millimeters(way.left), millimeters(found.written));
        let (text, next) = if k == 0 {
            let text = format!(
                "{meaning}; read this way, the measured poses match the commanded ones to within {left} (root mean square, in the \
                 best-fitting frames); as written, to within {written}"
            );
            (text, format!("{}; {see}", advice(&changes[0])))
        } else {
            (format!("alternatively, {meaning}"), see)
        };
        let size = format!("{left} instead of {written}");
        let read_as = changes.clone();
        Finding { probability: share, size, text, next, read_as, ..Finding::of(changes[0].kind()) }
    };
    found.ways.iter().enumerate().map(one).collect()
}

/// A length with two digits that matter.
fn millimeters(length: f64) -> String {
    let mm = length * 1e3;
    if mm < 10.0 { format!("{mm:.2} mm") } else { format!("{mm:.0} mm") }
}

impl AgainstWritten {
    /// A few words, and a sentence.
    fn words(self) -> (String, String) {
        let read_so = format!("read this way, the error is {} times the noise", times(self.other));
        let (size, written) = match self.written {
            AsWritten::Level(level) => (
                format!("error {} instead of {} times the noise", times(self.other), times(level)),
                format!("as written, the best explanation leaves {} times the noise", times(level)),
            ),
            AsWritten::Open(level) => (
                "stiffness undetermined".to_owned(),
                format!(
                    "as written, the file is explained to {} times the noise only by effects that leave the leg stiffnesses undetermined",
                    times(level)
                ),
            ),
            AsWritten::Negative => {
                ("negative stiffness".to_owned(), "as written, legs have a negative stiffness".to_owned())
            }
            AsWritten::Nothing => (
                "singular poses".to_owned(),
                "as written, the legs do not determine the motion of the platform".to_owned(),
            ),
        };
        (size, format!("{read_so}; {written}"))
    }
}

/// What to do for the answer of the file read so.
fn to_see(changes: &[Change]) -> String {
    let options: Vec<String> = changes.iter().map(|change| format!("--read-as {change}")).collect();
    format!("to see the result with this correction, add {}", options.join(" "))
}

fn times(level: f64) -> String {
    match level {
        x if x < 10.0 => format!("{x:.2}"),
        x if x < 1000.0 => format!("{x:.0}"),
        x => format!("{x:.0e}"),
    }
}

/// What the author of the file meant, if these are the mistakes.
pub(super) fn meanings(changes: &[Change]) -> String {
    changes.iter().map(meaning).collect::<Vec<_>>().join(", and ")
}

/// What the author of the file meant, if this is the mistake.
fn meaning(change: &Change) -> String {
    match change {
        Change::Reversed(signed) => format!("{} the other sign", reversed(*signed)),
        Change::StatesExchanged => "the columns of the loaded and of the reference state seem exchanged".to_owned(),
        Change::Scaled(group, factor) if change.sizes() > 0 => {
            format!("{} seem off by a constant factor: {factor:.4} times what the file holds", scaled(*group))
        }
        Change::Scaled(group, factor) => format!(
            "{} seem to be in {} the unit the file states{}",
            scaled(*group),
            multiple(*factor),
            units(*group, *factor)
        ),
        Change::Renamed(target, axes) => {
            let is_left = axes.handedness() < 0.0 && target.is_of_vectors();
            let hand = if is_left { ", which are left-handed" } else { "" };
            format!("x, y, z of {} seem to be {axes} of the file{hand}", written_in(*target))
        }
        Change::Turned(target, by) => {
            format!("the axes of {} seem turned by {:.1} degrees", written_in(*target), by.norm().to_degrees())
        }
        Change::LegOrder(order) => {
            let legs = order.map(|k| (k + 1).to_string()).join(", ");
            format!("the legs seem to end at the platform joints {legs}, in this order")
        }
        Change::JointsExchanged => "base joints and platform joints seem exchanged".to_owned(),
        Change::Origin(origin, at) => of_origin(*origin, &(at * 1e3)),
        Change::Joint(coordinate, off) => {
            format!("the joint coordinate {coordinate} of the hexapod file seems off by {:.2} mm", -off * 1e3)
        }
        Change::WrenchMobile => "the loads seem to be written in the axes of the platform, not in fixed axes".to_owned(),
        Change::MomentsMobile => "the moments seem to be written in the axes of the platform, not in fixed axes".to_owned(),
        Change::DeflectionMobile => "the deflections seem to be written in the axes of the platform, not in fixed axes".to_owned(),
        Change::Angles(order) => format!("{}, it seems, in poses and deflections", order.text()),
        Change::PoseAngles(order) => format!("{}, it seems, in the poses", order.text()),
        Change::OtherRotations => "the rotations seem to be a rotation vector where the file says differences of angles, or vice versa".to_owned(),
        Change::Preload(load) => {
            let [fx, fy, fz, mx, my, mz] = load.to_array();
            format!("a load seems to be missing in the file: about ({fx:.3}, {fy:.3}, {fz:.3}) N and ({mx:.3}, {my:.3}, {mz:.3}) N m in the reference state, or its opposite in the loaded state")
        }
        Change::LoadIsChange => "the load columns already seem to contain the change of load, loaded minus reference".to_owned(),
        Change::LoadHoldsReference => "the load columns seem to contain the load of the reference state twice".to_owned(),
        Change::Rows(order) => format!("rows seem to be shifted: {}", order.text()),
        Change::Pose(of, mistake) => mistake.meaning(*of),
        Change::Within(lines, multiple) => format!("in {lines} {}", meaning(&multiple.everywhere())),
        Change::SensorReversed(_)
        | Change::SensorScaled(..)
        | Change::SensorMoved(..)
        | Change::SensorTurned(..)
        | Change::SensorsExchanged(..)
        | Change::ZeroError(..) => of_sensors(change),
    }
}

/// Another point than the one stated, mm.
fn of_origin(origin: ReferencePoint, at: &Vector3) -> String {
    let point = format!("({:.1}, {:.1}, {:.1}) mm", at.x, at.y, at.z);
    match origin {
        ReferencePoint::MomentsFixed => format!(
            "the moments seem to be about the point {point} of the fixed frame, not about the mobile origin"
        ),
        ReferencePoint::MomentsMobile => format!(
            "the moments seem to be about the point {point} of the platform, not about the mobile origin"
        ),
        ReferencePoint::ReadingsMobile => format!(
            "the deflections seem to be those of the point {point} of the platform, not of the mobile origin"
        ),
        ReferencePoint::Poses => format!(
            "the positions of the poses seem to start at {point}, as if the home height were counted twice or left out"
        ),
        ReferencePoint::PlatformJoints => format!(
            "the platform joints seem to be given from {point}, as if the home height were counted twice or left out"
        ),
    }
}

fn of_sensors(change: &Change) -> String {
    match change {
        Change::SensorReversed(Sensors::One(name)) => {
            format!("sensor {name} seems to read with the other sign")
        }
        Change::SensorReversed(Sensors::All(kind)) => {
            format!("all sensors of kind {kind} seem to read with the other sign")
        }
        Change::SensorScaled(which, factor) if change.sizes() > 0 => format!(
            "the numbers of {} seem off by a constant factor: {factor:.4} times what the file holds",
            named(*which)
        ),
        Change::SensorScaled(which, factor) => format!(
            "the numbers of {} seem to be in {} the unit the file states",
            named(*which),
            multiple(*factor),
        ),
        Change::SensorMoved(name, by) => {
            let by = by * 1e3;
            format!(
                "the point of sensor {name} seems to be displaced by ({:.1}, {:.1}, {:.1}) mm on the platform",
                by.x, by.y, by.z
            )
        }
        Change::SensorTurned(name, by) => {
            format!("the direction of sensor {name} seems turned by {:.1} degrees", by.norm().to_degrees())
        }
        Change::SensorsExchanged(one, other) => {
            format!("the numbers of sensors {one} and {other} seem to have exchanged columns")
        }
        Change::ZeroError(ReadingColumn::Pose(k), error) => {
            let unit = if *k < 3 { "um" } else { "urad" };
            format!(
                "{} seems to have a zero error of {:.2} {unit} in every row",
                READINGS[usize::from(*k)],
                error * 1e6
            )
        }
        Change::ZeroError(ReadingColumn::Sensor(name), error) => {
            format!(
                "sensor column {name} seems to have a zero error of {:.2} um (urad if it reads an angle) in every row",
                error * 1e6
            )
        }
        _ => String::new(),
    }
}

fn named(which: Sensors) -> String {
    match which {
        Sensors::One(name) => format!("sensor {name}"),
        Sensors::All(kind) => format!("all sensors of kind {kind}"),
    }
}

fn reversed(signed: Signed) -> String {
    match signed {
        Signed::Readings => "the deflections seem to be reference minus loaded: they have".to_owned(),
        Signed::Translations => "the translations of the deflections seem to have".to_owned(),
        Signed::Rotations => "the rotations of the deflections seem to have".to_owned(),
        Signed::Reading(k) => format!("{} seems to have", READINGS[usize::from(k)]),
        Signed::Wrench => {
            "the loads seem to be those on the machine's support, not on the platform: they have".to_owned()
        }
        Signed::Forces => "the forces seem to have".to_owned(),
        Signed::Moments => "the moments seem to have".to_owned(),
        Signed::Load(k) => format!("{} seems to have", Wrench::NAMES[usize::from(k)]),
        Signed::Reference => {
            "the loads of the reference state, but not those of the loaded one, seem to have".to_owned()
        }
    }
}

fn scaled(group: Group) -> Cow<'static, str> {
    let column = |names: [&str; 6], k: u8| format!("the numbers of {}", names[usize::from(k)]);
    Cow::Borrowed(match group {
        Group::Translations => "the translations of the deflections",
        Group::Rotations => "the rotations of the deflections",
        Group::Readings => "the deflections",
        Group::Forces => "the forces",
        Group::Moments => "the moments",
        Group::Loads => "the loads",
        Group::PosePositions => "the positions of the poses",
        Group::PoseAngles => "the angles of the poses",
        Group::BaseJoints => "the base joints",
        Group::PlatformJoints => "the platform joints",
        Group::Joints => "the joints",
        Group::Reading(k) => return column(READINGS, k).into(),
        Group::Load(k) => return column(Wrench::NAMES, k).into(),
        Group::Noise => "the stated noise levels",
    })
}

fn written_in(target: Target) -> &'static str {
    match target {
        Target::Readings => "the deflections",
        Target::ReadingColumns => "the columns of the deflections",
        Target::TranslationColumns => "the translation columns of the deflections",
        Target::RotationColumns => "the rotation columns of the deflections",
        Target::Points => "the sensors that read points",
        Target::Wrench => "the loads",
        Target::WrenchColumns => "the columns of the loads",
        Target::ForceColumns => "the columns of the forces",
        Target::MomentColumns => "the columns of the moments",
        Target::Poses => "the poses",
        Target::PosePositionColumns => "the position columns of the poses",
        Target::PoseAngleColumns => "the angle columns of the poses",
        Target::Joints => "the joints",
        Target::BaseJoints => "the base joints",
        Target::PlatformJoints => "the platform joints",
    }
}

/// Pairs of units with this ratio, for those who look for the mistake.
fn units(group: Group, factor: f64) -> &'static str {
    let is = |ratio: f64| (factor / ratio - 1.0).abs() < 1e-3 || (factor * ratio - 1.0).abs() < 1e-3;
    let is_angle = matches!(group, Group::Rotations | Group::PoseAngles | Group::Readings);
    match group {
        _ if is_angle && is(57.295_78) => ": degrees and radians",
        _ if is_angle && is(4.848_137) => ": seconds of arc and microradians",
        _ if is_angle && is(17_453.292_5) => ": degrees and microradians",
        Group::Forces | Group::Moments | Group::Loads if is(9.806_65) => ": kilograms and newtons",
        Group::Forces | Group::Moments | Group::Loads if is(4.448_222) => ": pounds and newtons",
        Group::Moments if is(1e3) => ": newton millimeters and newton meters",
        _ if is(25.4) => ": inches and millimeters",
        _ => "",
    }
}

/// How many times a unit, or which part of it.
pub(super) fn multiple(factor: f64) -> String {
    if factor > 1.0 {
        format!("{} times", number(factor))
    } else {
        format!("1/{} of", number(factor.recip()))
    }
}

fn number(x: f64) -> String {
    if x < 1e4 {
        format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{x:.3e}")
    }
}

fn advice(change: &Change) -> Cow<'static, str> {
    if let Change::Angles(order) = change
        && let Some(convention) = order.convention()
    {
        let word = convention.word();
        return format!("look up the angle convention of the controller; if it is this one, write `angles = \"{word}\"` under [conventions] of the hexapod file").into();
    }
    Cow::Borrowed(match change {
        Change::Within(..) => {
            "look up in the measurement log what changed at these lines (a setting, an instrument, the operator), and \
             correct them"
        }
        Change::Reversed(_) | Change::StatesExchanged => {
            "pull on the platform by hand: a pull along an axis must move it along that axis; compare the signs of such a line, and \
             correct the file"
        }
        Change::Pose(..) => {
            "move the machine along and about each axis in turn, and check which number of the instrument changes, in which \
             direction and by how much; correct the columns"
        }
        Change::ZeroError(..) => {
            "zero the instrument with the platform under the reference load, check what it reads when nothing has changed, and take that off \
             the column"
        }
        Change::Scaled(..) | Change::SensorScaled(..) if change.sizes() > 0 => {
            "check the calibration factor of the instrument that reads these columns against a known step, and correct the values"
        }
        Change::SensorReversed(_) | Change::SensorScaled(..) | Change::SensorsExchanged(..) => {
            "move each sensor by hand and check which column changes, in which direction and by how much; correct the columns or the hexapod file"
        }
        Change::Scaled(..) => {
            "check the units of these columns against the instrument, and correct the names of the columns or the values"
        }
        Change::LegOrder(_) | Change::JointsExchanged | Change::Joint(..) => {
            "compare the joints of the hexapod file with the drawing, leg by leg, and correct it"
        }
        Change::Rows(_) => "compare the file with the measurement log, and put the rows in order",
        Change::Preload(_) | Change::LoadIsChange | Change::LoadHoldsReference => {
            "write the loads of both states, ref_fx_N to ref_mz_Nm and fx_N to mz_Nm, each as applied to the platform"
        }
        _ => {
            "check in which frame, about which point and in which convention these columns were written, and correct the file"
        }
    })
}
