//! What files may mean otherwise that have sensors, or some of the six pose numbers only.
//!
//! A sensor a little beside its place is no mistake of the file: the examination finds it, beside effects. One whose coordinates were
//! slipped in writing is far from it.

use std::f64::consts::PI;
use std::ops::Range;

use hexbench_core::{Channel, Dataset, Hexapod, Measurand, Sensor, Vector3};
use nalgebra::Rotation3;

use super::change::{Change, ReferencePoint, Sensors, Target};
use super::hypotheses;
use super::numbers::reads_one_of;
use super::turn::SignedAxes;
use crate::effects::intern;

/// Ratios in which the numbers of a sensor may be written.
pub(super) const SENSOR_FACTORS: [&[f64]; 2] = [&OF_LENGTHS, &OF_ANGLES];
/// Those of a gauge: inches, powers of ten, a lever of two.
const OF_LENGTHS: [f64; 5] = [25.4, 10.0, 1e3, 100.0, 2.0];
/// Those of a level: seconds of arc, thousandths, degrees, millimeters on a meter.
const OF_ANGLES: [f64; 4] = [PI / 0.648, 1e3, PI * 1e6 / 180.0, 2.0];

/// A sensor nearer to its place than this is a little beside it, m.
const ELSEWHERE: f64 = 0.01;

/// Everything that is tried.
pub(super) fn singles(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let others = hypotheses::singles(hexapod, data).into_iter();
    let others = others.filter(|change| is_of_these_readings(change, data) && is_likely_order(change));
    of_sensors(hexapod, data).into_iter().chain(others).collect()
}

/// What is tried beside another mistake.
pub(super) fn cheap(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let others =
        hypotheses::cheap(hexapod, data).into_iter().filter(|change| is_of_these_readings(change, data));
    of_sensors(hexapod, data).into_iter().chain(others).collect()
}

/// What may be wrong with sensors: one by one, all of a kind, two that are exchanged, the axes of points.
fn of_sensors(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let read: Vec<&Sensor> = read_sensors(hexapod, data);
    let mut all: Vec<Change> = read.iter().flat_map(|sensor| of_sensor(sensor)).collect();
    let kinds = ["distance", "point", "inclination", "leg-length"];
    let of_kind = |kind: &str| read.iter().filter(|s| s.kind.word() == kind).count();
    // All numbers of the file with another sign or in another unit are those of the readings.
    let is_part =
        |kind: &str| of_kind(kind) < read.len() || channels(data).any(|c| matches!(c, Channel::Pose(_)));
    for kind in kinds.into_iter().filter(|kind| of_kind(kind) > 1 && is_part(kind)) {
        let is_angle = kind == "inclination";
        all.extend(sign_and_factors(Sensors::All(kind), is_angle));
    }
    for (k, one) in read.iter().enumerate() {
        let like = read[k + 1..].iter().filter(|other| other.kind.word() == one.kind.word());
        all.extend(
            like.map(|other| Change::SensorsExchanged(intern::text(&one.name), intern::text(&other.name))),
        );
    }
    if of_kind("point") > 0 {
        all.extend(SignedAxes::all().into_iter().map(|axes| Change::Renamed(Target::Points, axes)));
    }
    all
}

/// Sensors that some column is of.
fn read_sensors<'a>(hexapod: &'a Hexapod, data: &Dataset) -> Vec<&'a Sensor> {
    let is_read =
        |index: usize| channels(data).any(|c| matches!(c, Channel::Sensor { sensor, .. } if sensor == index));
    hexapod.sensors.iter().enumerate().filter(|(index, _)| is_read(*index)).map(|(_, s)| s).collect()
}

fn channels(data: &Dataset) -> impl Iterator<Item = Channel> {
    data.blocks.iter().flatten().copied()
}

/// What may be wrong with one sensor.
fn of_sensor(sensor: &Sensor) -> Vec<Change> {
    let name = intern::text(&sensor.name);
    let mut all = sign_and_factors(Sensors::One(name), sensor.kind.is_angle());
    if sensor.kind.numbers() > 1 {
        let columns =
            (0..sensor.kind.numbers()).map(|number| Sensors::One(intern::text(&sensor.column(number))));
        all.extend(columns.flat_map(|column| sign_and_factors(column, false)));
    }
    if let Some(point) = sensor.kind.point() {
        let off = meant_points(point).map(|meant| meant - point);
        all.extend(off.filter(|off| off.norm() > ELSEWHERE).map(|off| Change::SensorMoved(name, off)));
    }
    if let Some(along) = sensor.kind.direction() {
        let axes = (0..3).map(|k| Vector3::ith(k, 1.0));
        let turns =
            axes.filter_map(|axis| Rotation3::rotation_between(along, &axis)).map(|turn| turn.scaled_axis());
        all.extend(turns.filter(|turn| turn.norm() > 0.1).map(|turn| Change::SensorTurned(name, turn)));
    }
    all
}

/// The point that its author may have meant: with another sign of a coordinate, or two coordinates exchanged.
fn meant_points(point: &Vector3) -> impl Iterator<Item = Vector3> {
    let signs = (0..3).map(|k| {
        let mut meant = *point;
        meant[k] = -meant[k];
        meant
    });
    let orders = [(0, 1), (1, 2), (0, 2)].map(|(i, j)| {
        let mut meant = *point;
        meant.swap_rows(i, j);
        meant
    });
    signs.chain(orders)
}

fn sign_and_factors(which: Sensors, is_angle: bool) -> Vec<Change> {
    let factors: &[f64] = if is_angle { &OF_ANGLES } else { &OF_LENGTHS };
    let scaled = factors.iter().flat_map(|f| [*f, f.recip()]).map(|f| Change::SensorScaled(which, f));
    std::iter::once(Change::SensorReversed(which)).chain(scaled).collect()
}

/// True for what speaks of loads, poses and joints, or of pose numbers that the file has columns of.
fn is_of_these_readings(change: &Change, data: &Dataset) -> bool {
    let has = |numbers: Range<usize>| channels(data).any(|c| reads_one_of(c, &numbers));
    let rotations = has(3..6);
    match change {
        Change::Reversed(_) | Change::Scaled(..) => change.pose_numbers().is_none_or(has),
        Change::Renamed(Target::Readings, axes) => has(0..6) && (rotations || axes.handedness() > 0.0),
        // Without rotations they are the same as vectors in other axes, but for the hand.
        Change::Renamed(Target::ReadingColumns, axes) => has(0..6) && (rotations || axes.handedness() < 0.0),
        Change::Renamed(Target::TranslationColumns | Target::RotationColumns, _) => has(0..3) && rotations,
        Change::OtherRotations => rotations,
        // What turns the numbers of a reading into each other takes all of them.
        Change::Turned(Target::Readings | Target::ReadingColumns, _)
        | Change::Origin(ReferencePoint::ReadingsMobile, _)
        | Change::DeflectionMobile => false,
        Change::Angles(_) => !(rotations && data.measurand == Measurand::DeflectionEuler),
        _ => true,
    }
}

/// Of all orders of legs, those that a table can get by one slip: started elsewhere, written backwards, two lines exchanged.
fn is_likely_order(change: &Change) -> bool {
    let Change::LegOrder(order) = change else { return true };
    let moved = order.iter().enumerate().filter(|(k, leg)| *k != usize::from(**leg)).count();
    let follows = |step: u8| order.windows(2).all(|pair| (pair[0] + step) % 6 == pair[1]);
    moved == 2 || follows(1) || follows(5)
}

#[cfg(test)]
mod tests {
    use hexbench_core::SensorKind;

    use super::*;
    use crate::test_machine::readings;

    fn ball(height: f64) -> Sensor {
        let point = Vector3::new(0.1, 0.2, height);
        Sensor::new("ball", SensorKind::Point { point, sigma: [1e-6; 3] })
    }

    #[test]
    fn a_sensor_less_than_a_centimeter_from_its_place_is_no_mistake_of_the_file() {
        let mirrored = |height: f64| {
            let is_mirrored =
                |c: &Change| matches!(c, Change::SensorMoved(_, off) if off.xy().norm() < 1e-12);
            of_sensor(&ball(height)).iter().filter(|c| is_mirrored(c)).count()
        };
        assert_eq!([0.0049, 0.0051].map(mirrored), [0, 1]);
    }

    #[test]
    fn numbers_and_axes_of_a_point_may_be_wrong_by_themselves() {
        let along = Vector3::new(1.0, 0.0, 0.0);
        let gauge = SensorKind::Distance { point: Vector3::zeros(), direction: along, sigma: 1e-6 };
        for (sensor, signs, axes) in [(ball(0.0), 4, 47), (Sensor::new("gauge", gauge), 1, 0)] {
            let (hexapod, data) = readings(Measurand::DeflectionRotationVector, vec![sensor]);
            let all = of_sensors(&hexapod, &data);
            let count = |is: fn(&Change) -> bool| all.iter().filter(|c| is(c)).count();
            assert_eq!(count(|c| matches!(c, Change::SensorReversed(_))), signs);
            assert_eq!(count(|c| matches!(c, Change::Renamed(Target::Points, _))), axes);
        }
    }
}
