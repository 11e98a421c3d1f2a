//! Joints copied wrongly from a drawing: a sign, two digits, a diameter for a radius, a platform turned.

use hexbench_core::{Hexapod, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Misstatement, MisstatementEntry};
use crate::so3::exp;

/// Smallest coordinate hit by a slip of the pen, m.
const LEAST_M: f64 = 0.02;
const MM_PER_M: f64 = 1e3;
const JOINT: &[&str] = &["geometry", "tolerance"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Machine "joint-sign" "One coordinate of one joint has the opposite sign.", JOINT => Slip::Sign;
    Machine "joint-digits" "Two digits of one coordinate of one joint are exchanged, tens and units of mm.",
        JOINT => Slip::Digits;
    Machine "joint-off-10mm" "One coordinate of one joint is off by 10 mm.", JOINT => Slip::Ten;
    Machine "platform-diameter-as-radius" "The joints of the platform lie on twice their radius: a diameter was taken for it.",
        &["geometry", "unit"] => Platform::Diameter;
    Machine "platform-turned-60" "The platform is drawn turned by 60 deg against the base.",
        &["geometry", "axes", "leg-order"] => Platform::Turned;
];

/// A slip of the pen.
#[derive(Debug)]
enum Slip {
    Sign,
    Digits,
    Ten,
}

impl Slip {
    /// The coordinate as written, m.
    fn of(&self, x: f64) -> f64 {
        match self {
            Self::Sign => -x,
            Self::Ten => x + 10.0 / MM_PER_M,
            Self::Digits => {
                let whole = (x.abs() * MM_PER_M).floor();
                let (tens, units) = ((whole / 10.0).floor() % 10.0, whole % 10.0);
                x + x.signum() * 9.0 * (units - tens) / MM_PER_M
            }
        }
    }

    fn hits(&self, x: f64) -> bool {
        x.abs() >= LEAST_M && (self.of(x) - x).abs() * MM_PER_M >= 1.0
    }
}

impl Misstatement for Slip {
    fn describe(&self, hexapod: &mut Hexapod, rng: &mut Pcg64) {
        let coordinates = hexapod.base_joints.iter_mut().chain(&mut hexapod.platform_joints);
        let mut hit: Vec<&mut f64> =
            coordinates.flat_map(|joint| joint.iter_mut()).filter(|x| self.hits(**x)).collect();
        if !hit.is_empty() {
            let one = rng.random_range(0..hit.len());
            *hit[one] = self.of(*hit[one]);
        }
    }
}

/// The platform drawn wrongly.
#[derive(Debug)]
enum Platform {
    Diameter,
    Turned,
}

impl Misstatement for Platform {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        let turn = exp(&(Vector3::z() * 60_f64.to_radians()));
        hexapod.platform_joints = hexapod.platform_joints.map(|b| match self {
            Self::Diameter => Vector3::new(2.0 * b.x, 2.0 * b.y, b.z),
            Self::Turned => turn * b,
        });
    }
}
