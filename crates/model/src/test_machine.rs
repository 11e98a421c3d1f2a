//! A machine for tests, of the size of the paper's, and readings of it.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

use hexbench_core::{
    Columns, Dataset, Hexapod, Measurand, Observation, Pose, Sensor, Vector3, Vector6, Wrench,
};

use crate::estimation::frames::ReadingAxes;
use crate::machine::geometry::Machine;

/// Joints in pairs on rings of 160 and 120 mm, 165 mm apart.
pub(crate) fn machine() -> Hexapod {
    let joint = |r: f64, deg: f64, z: f64| {
        let (s, c) = deg.to_radians().sin_cos();
        Vector3::new(r * c, r * s, z)
    };
    Hexapod::of_joints(
        "ring",
        [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0].map(|d| joint(0.16, d, -0.165)),
        [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0].map(|d| joint(0.12, d, 0.0)),
    )
}

/// A machine of springs and readings of it at three poses under loads of every kind, by sensors where there are any.
pub(crate) fn readings(measurand: Measurand, sensors: Vec<Sensor>) -> (Hexapod, Dataset) {
    let hexapod = Hexapod { sensors, ..machine() };
    let springs = Vector6::repeat(1e-7);
    let rows = (0..9_u32).map(|i| {
        let x = f64::from(i);
        let pose = [
            0.01 * (x / 3.0).floor(),
            -0.005,
            0.004 * (x / 3.0).floor(),
            0.05,
            -0.04 * (x / 3.0).floor(),
            0.06,
        ];
        let pose_of = Pose::from_array(pose);
        let wrench = Wrench {
            force: Vector3::new(100.0 - 30.0 * x, 20.0 * x, -200.0),
            moment: Vector3::new(5.0, -4.0 + x, 3.0),
        };
        let reference = Wrench { force: Vector3::new(0.0, 0.0, -50.0), moment: Vector3::zeros() };
        let mut o = Observation { line: u64::from(2 + i), ..Observation::unread(pose_of, wrench, reference) };
        let legs = Machine::nominal(&hexapod).legs(&o.pose).unwrap();
        let change = o.wrench.to_vector() - o.reference.to_vector();
        let mut read = legs.platform_jacobian * springs.component_mul(&legs.forces(&change));
        if measurand == Measurand::DeflectionEuler {
            let turned = ReadingAxes::default().rates(&pose) * read.fixed_rows::<3>(3);
            read.fixed_rows_mut::<3>(3).copy_from(&turned);
        }
        if measurand == Measurand::AbsolutePose {
            read += Vector6::from(pose);
        }
        o.measured = read.into();
        o
    });
    let observations = rows.collect();
    let poses = Dataset::of_poses("", measurand, Columns::default(), observations);
    let read = if hexapod.sensors.is_empty() { poses } else { poses.to_be_read_by(&hexapod.sensors) };
    (hexapod, read)
}
