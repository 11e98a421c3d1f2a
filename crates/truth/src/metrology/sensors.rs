//! What sensors read: the exact finite displacement between the reference and the loaded state.

use hexbench_core::{Hexapod, Pose, Sensor, SensorKind, Vector3};
use nalgebra::Rotation3;

/// The numbers of all sensors of a machine whose platform stands first at one pose and then at another, sensor by sensor; m and rad.
pub fn read_sensors(hexapod: &Hexapod, [reference, loaded]: &[Pose; 2]) -> Vec<f64> {
    let at = |pose: &Pose, point: &Vector3| pose.rotation() * point + pose.translation;
    let moved = |point: &Vector3| at(loaded, point) - at(reference, point);
    let turned = || {
        let turn = loaded.rotation() * reference.rotation().transpose();
        Rotation3::from_matrix_unchecked(turn).scaled_axis()
    };
    let length =
        |pose: &Pose, leg: usize| (at(pose, &hexapod.platform_joints[leg]) - hexapod.base_joints[leg]).norm();
    let numbers = |kind: &SensorKind| match kind {
        SensorKind::Distance { point, direction, .. } => vec![direction.dot(&moved(point))],
        SensorKind::Point { point, .. } => moved(point).iter().copied().collect(),
        SensorKind::Inclination { axis, .. } => vec![axis.dot(&turned())],
        SensorKind::LegLength { leg, .. } => vec![length(loaded, *leg) - length(reference, *leg)],
        SensorKind::Function { of, .. } => {
            let [before, after] = of.at(&[*reference, *loaded]);
            vec![after - before]
        }
    };
    let shown = |sensor: &Sensor| -> Vec<f64> {
        numbers(&sensor.kind).into_iter().map(|number| sensor.gain * number).collect()
    };
    hexapod.sensors.iter().flat_map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(kind: SensorKind) -> Hexapod {
        let corner = |k: f64, z: f64| Vector3::new(k.cos(), k.sin(), z);
        let joints = |z: f64| std::array::from_fn(|k| corner(k as f64, z));
        let mut hexapod = Hexapod::of_joints("ring", joints(-1.0), joints(0.0));
        hexapod.sensors.push(Sensor::new("s", kind));
        hexapod
    }

    fn states() -> [Pose; 2] {
        let pose = |shift: f64, angle: f64| Pose {
            translation: Vector3::new(0.0, 0.0, shift),
            angles: Vector3::new(0.0, 0.0, angle),
        };
        [pose(0.0, 0.0), pose(0.5, std::f64::consts::FRAC_PI_2)]
    }

    #[test]
    fn a_quarter_turn_is_read_whole() {
        let point = Vector3::new(2.0, 0.0, 0.0);
        let near = |read: &[f64], expected: &[f64]| {
            assert_eq!(read.len(), expected.len());
            read.iter().zip(expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{read:?}"));
        };
        let read = |kind| read_sensors(&with(kind), &states());
        near(&read(SensorKind::Point { point, sigma: [1.0; 3] }), &[-2.0, 2.0, 0.5]);
        near(&read(SensorKind::Distance { point, direction: Vector3::x(), sigma: 1.0 }), &[-2.0]);
        near(
            &read(SensorKind::Inclination { axis: Vector3::z(), sigma: 1.0 }),
            &[std::f64::consts::FRAC_PI_2],
        );
        // The joint at (1, 0, 0) goes to (0, 1, 0.5); its leg begins at (1, 0, -1).
        near(&read(SensorKind::LegLength { leg: 0, sigma: 1.0 }), &[(1.0 + 1.0 + 2.25_f64).sqrt() - 1.0]);
    }
}
