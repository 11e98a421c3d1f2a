//! A machine for tests, of the size of the paper's.

use hexbench_core::{Hexapod, Vector3};

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
