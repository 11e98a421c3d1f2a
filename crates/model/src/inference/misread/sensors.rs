//! What files of machines with sensors may mean otherwise: signs, factors and axes of a sensor, loads, joints.
//!
//! A sensor a little beside its place is no mistake of the file: the examination finds it, beside effects.

use std::f64::consts::PI;

use hexbench_core::{Dataset, Hexapod, Sensor, Vector3};
use nalgebra::Rotation3;

use super::change::{Change, Group, ReferencePoint, Signed, Target};
use super::hypotheses;
use crate::effects::intern;

/// Ratios in which the numbers of a gauge may be written: inches, powers of ten, a lever of two.
const OF_LENGTHS: [f64; 5] = [25.4, 10.0, 1e3, 100.0, 2.0];
/// The same of a level: seconds of arc, thousandths, degrees, millimetres on a metre.
const OF_ANGLES: [f64; 4] = [PI / 0.648, 1e3, PI * 1e6 / 180.0, 2.0];

/// Everything that is tried.
pub(super) fn singles(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let of_sensors = hexapod.sensors.iter().flat_map(of_sensor);
    let others = hypotheses::singles(hexapod, data).into_iter();
    of_sensors.chain(others.filter(concerns_no_pose_number).filter(is_likely_order)).collect()
}

/// What may be wrong with one sensor.
fn of_sensor(sensor: &Sensor) -> Vec<Change> {
    let name = intern::text(&sensor.name);
    let factors: &[f64] = if sensor.kind.is_angle() { &OF_ANGLES } else { &OF_LENGTHS };
    let mut all = vec![Change::SensorReversed(name)];
    all.extend(factors.iter().flat_map(|f| [*f, f.recip()]).map(|f| Change::SensorScaled(name, f)));
    if let Some(along) = sensor.kind.direction() {
        let axes = (0..3).map(|k| Vector3::ith(k, 1.0));
        let turns =
            axes.filter_map(|axis| Rotation3::rotation_between(along, &axis)).map(|turn| turn.scaled_axis());
        all.extend(turns.filter(|turn| turn.norm() > 0.1).map(|turn| Change::SensorTurned(name, turn)));
    }
    all
}

/// True for what speaks of loads, poses and joints, not of six measured numbers.
fn concerns_no_pose_number(change: &Change) -> bool {
    match change {
        Change::Reversed(signed) => {
            matches!(
                signed,
                Signed::Wrench | Signed::Forces | Signed::Moments | Signed::Load(_) | Signed::Reference
            )
        }
        Change::Scaled(group, _) => !matches!(
            group,
            Group::Translations | Group::Rotations | Group::Readings | Group::Reading(_) | Group::Noise
        ),
        Change::Renamed(target, _) | Change::Turned(target, _) => {
            !matches!(target, Target::Readings | Target::ReadingColumns)
        }
        Change::Origin(origin, _) => !matches!(origin, ReferencePoint::ReadingsMobile),
        Change::DeflectionMobile | Change::OtherRotations | Change::Angles(_) | Change::Rows(_) => false,
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
