//! A machine for tests, of the size of the paper's.

use hexbench_core::{Hexapod, Vector3, Wrench};

use crate::space::{Conditions, Loading};
use crate::{Budget, Space};

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

/// Level poses under a weight, as in the paper.
pub(crate) fn level_space() -> Space {
    let weight = |n: f64| Wrench::from_array([0.0, 0.0, -n, 0.0, 0.0, 0.0]);
    let reach = [0.04, 0.04, 0.02, 0.0, 0.0, 0.5];
    Space {
        low: reach.map(|x| -x),
        high: reach,
        stroke: Some([0.178, 0.211]),
        joint_angle: None,
        least_dexterity: 0.0,
        loads: vec![Loading { reference: weight(119.7), load: weight(338.4) }],
        load_ranges: Vec::new(),
        conditions: Conditions::default(),
        budget: Budget::default(),
    }
}
