//! What sensors read of the first world against where the second world has brought their points.

use std::sync::Arc;

use hexbench_core::{Hexapod, Pose, Sensor, SensorKind, Vector3};
use hexbench_rapier::{RapierStatics, cross_check::CrossCheckCase};
use hexbench_truth::mechanisms;
use hexbench_truth::metrology::read_sensors;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion};
use rayon::prelude::*;

const SEED: u64 = 4_711;
/// One machine for each effect, and for none.
const CASES: usize = mechanisms::REGISTRY.len() + 1;
/// Agreement asked for, as a share of the largest reading of a kind: that of the worlds themselves.
const AGREEMENT: f64 = 1e-4;
/// A gauge this far from its place is noticed, in radii of the platform.
const BESIDE: f64 = 0.05;

/// A gauge, a reflector, a level about each axis and a scale beside each leg.
fn with_sensors(hexapod: &Hexapod) -> Hexapod {
    let radius = 1.3 * hexapod.platform_radius();
    let at = |x: f64, y: f64, z: f64| Vector3::new(x, y, z) * radius;
    let direction = Vector3::new(0.3, -0.5, 0.9).normalize();
    let level = |k: usize| SensorKind::Inclination { axis: Vector3::ith(k, 1.0), sigma: 1e-6 };
    let kinds = [
        SensorKind::Distance { point: at(0.8, -0.6, 0.3), direction, sigma: 1e-7 },
        SensorKind::Point { point: at(-0.6, 0.8, -0.2), sigma: [1e-7; 3] },
    ]
    .into_iter()
    .chain((0..3).map(level))
    .chain((0..6).map(|leg| SensorKind::LegLength { leg, sigma: 1e-7 }));
    let sensors = kinds.enumerate().map(|(k, kind)| Sensor::new(format!("s{k}"), kind)).collect();
    Hexapod { sensors, ..hexapod.clone() }
}

/// The platform as a rigid body: the turn about three axes, one after the other.
fn body(pose: &Pose) -> Isometry3<f64> {
    let about = |k: usize| UnitQuaternion::from_axis_angle(&Vector3::ith_axis(k), pose.angles[k]);
    Isometry3::from_parts(Translation3::from(pose.translation), about(2) * about(1) * about(0))
}

/// Readings off two states of a rigid body; written apart from the instrument of the first world.
fn off_bodies(hexapod: &Hexapod, [before, after]: &[Isometry3<f64>; 2]) -> Vec<f64> {
    let shift = |p: &Vector3| after * Point3::from(*p) - before * Point3::from(*p);
    let one = |sensor: &Sensor| match &sensor.kind {
        SensorKind::Distance { point, direction, .. } => vec![shift(point).dot(direction)],
        SensorKind::Point { point, .. } => shift(point).iter().copied().collect(),
        SensorKind::Inclination { axis, .. } => {
            vec![(after.rotation * before.rotation.inverse()).scaled_axis().dot(axis)]
        }
        SensorKind::LegLength { leg, .. } => {
            let foot = Point3::from(hexapod.base_joints[*leg]);
            let head = Point3::from(hexapod.platform_joints[*leg]);
            vec![nalgebra::distance(&(after * head), &foot) - nalgebra::distance(&(before * head), &foot)]
        }
        SensorKind::Function { .. } => unreachable!("no file holds one"),
    };
    hexapod.sensors.iter().flat_map(one).collect()
}

/// Largest difference of lengths and of angles, each over the largest reading of its kind.
fn apart(hexapod: &Hexapod, first: &[f64], second: &[f64]) -> f64 {
    let angles = hexapod.sensors.iter().flat_map(|s| vec![s.kind.is_angle(); s.kind.numbers()]);
    let pairs: Vec<(bool, f64, f64)> =
        angles.zip(first).zip(second).map(|((angle, a), b)| (angle, *a, *b)).collect();
    let of = |wanted: bool| {
        let kind = || pairs.iter().filter(move |p| p.0 == wanted);
        let largest = kind().map(|p| p.1.abs()).fold(0.0, f64::max);
        kind().map(|p| (p.1 - p.2).abs()).fold(0.0, f64::max) / largest
    };
    of(true).max(of(false))
}

/// Differences of a case; and with the gauge looked for beside its place.
fn differences(index: usize) -> [f64; 2] {
    let case = CrossCheckCase::draw(index, SEED);
    let hexapod = with_sensors(&case.hexapod);
    let mut second = case.world();
    second.statics = Arc::new(RapierStatics::default());
    let states = |world: &hexbench_truth::World| {
        world.before_and_after(&case.situation).unwrap_or_else(|e| panic!("case {index}: {e}"))
    };
    let read = read_sensors(&hexapod, &states(&case.world()));
    let bodies = states(&second).each_ref().map(body);
    let mut beside = hexapod.clone();
    if let SensorKind::Distance { point, .. } = &mut beside.sensors[0].kind {
        *point += Vector3::new(1.0, 1.0, 1.0) * (BESIDE * hexapod.platform_radius());
    }
    [&hexapod, &beside].map(|placed| apart(&hexapod, &read, &off_bodies(placed, &bodies)))
}

#[test]
fn sensors_read_what_the_second_world_moves_them_by() {
    let all: Vec<[f64; 2]> = (0..CASES).into_par_iter().map(differences).collect();
    let worst = all.iter().map(|d| d[0]).fold(0.0, f64::max);
    assert!(worst < AGREEMENT, "{worst:e}");
    // The comparison notices a gauge that stands elsewhere.
    let noticed = all.iter().filter(|d| d[1] > 3.0 * AGREEMENT).count();
    assert!(noticed > CASES * 9 / 10, "{noticed} of {CASES}: {all:?}");
}
