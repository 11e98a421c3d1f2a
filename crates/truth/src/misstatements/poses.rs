//! Absolute poses: what an instrument measured, or the loads beside it, written otherwise than meant.
//!
//! Frames make up for right-handed axes and for any origin; they do not for a sign, a unit, columns that are exchanged, or angles of another
//! convention.

use std::f64::consts::PI;

use hexbench_core::{Dataset, Hexapod, Matrix3, Observation, Pose, Vector3};
use rand_pcg::Pcg64;

use super::angles::Convention;
use super::numbers::{FIRST, LAST, Numbers, Scaled};
use super::parts::Partly;
use super::rotations::{translation, write};
use super::rows::Apart;
use super::{Misstatement, MisstatementEntry};

/// In axes that coincide, a commanded pose that is wrong looks like a measured one.
const POSE: &[&str] = &["measured-pose", "commanded-pose"];
const CONVENTION: &[&str] = &["measured-pose", "angle-convention"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "measured-x-negated" "Measured positions along x have the other sign.", POSE
        => Scaled { numbers: Numbers::Reading(&[0]), factor: -1.0 } => of_absolute_poses();
    Tables "measured-alpha-negated" "The measured angle about x is positive clockwise.", POSE
        => Scaled { numbers: Numbers::Reading(&[3]), factor: -1.0 } => of_absolute_poses();
    Tables "measured-angles-negated" "Measured angles are positive clockwise.", POSE
        => Scaled { numbers: Numbers::Reading(LAST), factor: -1.0 } => of_absolute_poses();
    Tables "measured-angles-rad" "Measured angles are written in radians.", POSE
        => Scaled { numbers: Numbers::Reading(LAST), factor: PI / 180.0 } => of_absolute_poses();
    Tables "measured-positions-inch" "Measured positions are written in inches.", POSE
        => Scaled { numbers: Numbers::Reading(FIRST), factor: 1.0 / 25.4 } => of_absolute_poses();
    Tables "measured-x-y-exchanged" "The columns of the measured positions along x and y are exchanged.", POSE
        => Other::Exchanged => of_absolute_poses();
    Tables "measured-left-handed" "The instrument reads in left-handed axes.", POSE
        => Other::LeftHanded => of_absolute_poses();
    Tables "measured-inverse" "The instrument reads the fixed frame, seen from the platform.", POSE
        => Other::Inverse => of_absolute_poses();
    Tables "measured-angles-intrinsic" "Measured angles are consecutive turns about axes that move with the platform.",
        CONVENTION => Other::Intrinsic => of_absolute_poses();
    Tables "measured-shifted-row" "Measured poses are shifted by one row.", &["row-order"]
        => Apart::ReadingsByRow => of_absolute_poses();
    Tables "absolute-fz-negated" "Vertical forces are those of the platform on the load.", &["wrench-sign"]
        => Scaled { numbers: Numbers::Load(&[2]), factor: -1.0 } => of_absolute_poses();
    Measurements "measured-alpha-negated-partly" "From some row on, or up to it, the measured angle about x is positive clockwise.",
        POSE => Partly { numbers: Numbers::Reading(&[3]), factor: -1.0 } => of_absolute_poses();
    Measurements "measured-positions-m-partly" "From some row on, or up to it, measured positions are written in m.",
        POSE => Partly { numbers: Numbers::Reading(FIRST), factor: 1e-3 } => of_absolute_poses();
];

/// A measured pose written in another way.
#[derive(Debug)]
enum Other {
    /// Positions along x and y in each other's columns.
    Exchanged,
    /// The y of the instrument points the other way.
    LeftHanded,
    Inverse,
    Intrinsic,
}

impl Misstatement for Other {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        data.observations.iter_mut().for_each(|row| self.rewrite(row));
    }
}

impl Other {
    fn rewrite(&self, row: &mut Observation) {
        let (shift, turn) = (translation(row), Pose::from_array(row.measured).rotation());
        match self {
            Self::Exchanged => row.measured.swap(0, 1),
            Self::LeftHanded => {
                let q = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
                row.measured = Pose::from_rotation(q * shift, &(q * turn * q)).to_array();
            }
            Self::Inverse => {
                let back = turn.transpose();
                row.measured = Pose::from_rotation(-(back * shift), &back).to_array();
            }
            Self::Intrinsic => write(row, 3, &Convention::Intrinsic.of(&turn)),
        }
    }
}
