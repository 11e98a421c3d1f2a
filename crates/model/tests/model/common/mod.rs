//! Machines, plans, random numbers and a small independent world shared by the chapters.

pub(crate) mod plan;
pub(crate) mod random;
pub(crate) mod structure;
pub(crate) mod terms;
pub(crate) mod world;

use hexbench_core::{Hexapod, Matrix6, Metrology, Vector3, Vector6};

/// Stiffnesses of the six legs, N/m (Kalas et al. 2018, table 2).
pub(crate) const PAPER_STIFFNESS: [f64; 6] = [4.1981e6, 3.7898e6, 2.7503e6, 4.3200e6, 3.6716e6, 3.7288e6];

/// A hexapod from joints alone.
pub(crate) fn hexapod(base_joints: [Vector3; 6], platform_joints: [Vector3; 6]) -> Hexapod {
    Hexapod::of_joints("test machine", base_joints, platform_joints)
}

/// Joints on a circle. `degrees` along the circle, radius and height in m.
pub(crate) fn ring(radius: f64, degrees: [f64; 6], z: f64) -> [Vector3; 6] {
    degrees.map(|d| {
        let (sine, cosine) = d.to_radians().sin_cos();
        Vector3::new(radius * cosine, radius * sine, z)
    })
}

/// A geometry that agrees with the published numbers of Kalas et al. 2018, whose own is not published: base radius
/// 160 mm, platform radius 120 mm, height 165 mm, joints +-10 deg about the axes of each ring.
pub(crate) fn paper_machine() -> Hexapod {
    let base = ring(0.16, [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0], -0.165);
    let platform = ring(0.12, [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0], 0.0);
    hexapod(base, platform)
}

/// The same machine with a stated noise of one reading, m and rad.
pub(crate) fn measured_machine(sigma_translation: f64, sigma_rotation: f64) -> Hexapod {
    Hexapod { metrology: Some(Metrology { sigma_translation, sigma_rotation }), ..paper_machine() }
}

/// Largest element of the difference over the largest element of the reference.
pub(crate) fn relative_difference(a: &Matrix6, reference: &Matrix6) -> f64 {
    (a - reference).amax() / reference.amax()
}

/// A twist or wrench from its translational and its rotational half.
pub(crate) fn six(upper: &Vector3, lower: &Vector3) -> Vector6 {
    Vector6::new(upper.x, upper.y, upper.z, lower.x, lower.y, lower.z)
}
