//! The height between the plates is counted twice, left out, or counted down.
//!
//! At the zero pose both frames coincide, so that the height is in the joints: `h = mean z of B_i - mean z of A_i`.

use hexbench_core::{Dataset, Hexapod, Vector3};
use rand_pcg::Pcg64;

use super::{Misstatement, MisstatementEntry};

/// What a plate adds to the height of its joints, m.
const PLATE_M: f64 = 0.02;

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "height-in-poses-too" "Poses count c from the base, so that the home height is there twice.",
        &["origin"] => Poses;
    Machine "platform-joints-from-base" "Platform joints are counted from the base, so that the home height is there twice.",
        &["origin", "geometry"] => Heights::Twice;
    Machine "home-height-missing" "Both planes of joints are at z = 0, the home height is left out.",
        &["origin", "geometry"] => Heights::Missing;
    Machine "height-of-plates" "Heights are those of the plates, 20 mm beyond the joints.",
        &["origin", "geometry"] => Heights::Plates;
    Machine "base-z-positive-down" "Base joints have their depth below the origin as a positive z.",
        &["geometry", "axes"] => Heights::Down;
];

/// Height of the platform joints over the base joints at the zero pose, m.
fn height(hexapod: &Hexapod) -> f64 {
    let mean = |joints: &[Vector3; 6]| joints.iter().map(|p| p.z).sum::<f64>() / 6.0;
    mean(&hexapod.platform_joints) - mean(&hexapod.base_joints)
}

/// Poses counted from the base.
#[derive(Debug)]
struct Poses;

impl Misstatement for Poses {
    fn write(&self, data: &mut Dataset, hexapod: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            row.pose.translation.z += height(hexapod);
        }
    }
}

/// Joints at another height.
#[derive(Debug)]
enum Heights {
    Twice,
    Missing,
    Plates,
    Down,
}

impl Misstatement for Heights {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        let h = height(hexapod);
        let shift = |by: f64| move |p: Vector3| p + Vector3::z() * by;
        match self {
            Self::Twice => hexapod.platform_joints = hexapod.platform_joints.map(shift(h)),
            Self::Missing => hexapod.base_joints = hexapod.base_joints.map(shift(h)),
            Self::Plates => hexapod.base_joints = hexapod.base_joints.map(shift(-PLATE_M)),
            Self::Down => hexapod.base_joints = hexapod.base_joints.map(|a| Vector3::new(a.x, a.y, -a.z)),
        }
    }
}
