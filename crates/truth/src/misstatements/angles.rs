//! Angles of another convention.
//!
//! The format wants `R = Rz(gamma) Ry(beta) Rx(alpha)`. Vendors mean by three angles other products, by a rotation the vector of its
//! axis, by a positive angle the other way round.

use hexbench_core::{Dataset, Hexapod, Matrix3, Measurand, Observation, Vector3};
use rand_pcg::Pcg64;

use super::numbers::{LAST, Numbers, Scaled};
use super::rotations::{angles, states, write};
use super::{Misstatement, MisstatementEntry};
use crate::so3::log;

const CONVENTION: &[&str] = &["angle-convention"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "pose-angles-intrinsic" "Angles of poses are consecutive turns about axes that move with the platform: R = Rx Ry Rz.",
        CONVENTION => Poses(Convention::Intrinsic);
    Tables "pose-angles-xzy" "Angles of poses are of the order R = Rx Rz Ry.", CONVENTION
        => Poses(Convention::Cyclic(1));
    Tables "pose-angles-yxz" "Angles of poses are of the order R = Ry Rx Rz.", CONVENTION
        => Poses(Convention::Cyclic(2));
    Tables "pose-angles-rotation-vector" "Angles of poses are a rotation vector.", CONVENTION
        => Poses(Convention::Vector);
    Tables "pose-angles-yaw-pitch-roll" "Angles of poses are listed with that about z first.",
        &["angle-convention", "axes"] => Poses(Convention::ZFirst);
    Tables "pose-angles-negated" "Angles of poses are positive clockwise.",
        &["angle-convention", "rotation-sign"] => Scaled { numbers: Numbers::Pose(LAST), factor: -1.0 };
    Tables "all-angles-intrinsic" "Angles of poses and their differences as readings are of the order R = Rx Ry Rz.",
        CONVENTION => PosesAndReadings(Convention::Intrinsic);
    Tables "euler-as-rotation-vector" "Differences of Euler angles stand in the columns of a rotation vector.",
        &["rotation-convention"] => Readings::EulerAsVector;
    Tables "rotation-vector-as-euler" "Rotation vectors stand in the columns of differences of Euler angles.",
        &["rotation-convention"] => Readings::VectorAsEuler;
];

/// What three angles mean.
#[derive(Debug, Clone, Copy)]
pub(super) enum Convention {
    /// `R = Rx(alpha) Ry(beta) Rz(gamma)`.
    Intrinsic,
    /// The product of the format with every axis moved on by so many places.
    Cyclic(usize),
    /// A rotation vector.
    Vector,
    /// Those of the format, gamma first.
    ZFirst,
}

impl Convention {
    pub(super) fn of(self, r: &Matrix3) -> Vector3 {
        match self {
            Self::Intrinsic => -angles(&r.transpose()),
            Self::Cyclic(places) => {
                let moved = |i: usize| (i + places) % 3;
                let own = angles(&Matrix3::from_fn(|i, j| r[(moved(i), moved(j))]));
                let mut written = Vector3::zeros();
                (0..3).for_each(|k| written[moved(k)] = own[k]);
                written
            }
            Self::Vector => log(r),
            Self::ZFirst => {
                let own = angles(r);
                Vector3::new(own.z, own.y, own.x)
            }
        }
    }
}

/// Commanded poses in another convention.
#[derive(Debug)]
struct Poses(Convention);

impl Misstatement for Poses {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            row.pose.angles = self.0.of(&row.pose.rotation());
        }
    }
}

/// Commanded poses and readings in another convention.
#[derive(Debug)]
struct PosesAndReadings(Convention);

impl Misstatement for PosesAndReadings {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            let [before, after] = states(row).map(|r| self.0.of(&r));
            write(row, 3, &(after - before));
            row.pose.angles = before;
        }
    }
}

/// Rotations read that are of the other kind than their columns.
#[derive(Debug)]
enum Readings {
    EulerAsVector,
    VectorAsEuler,
}

impl Misstatement for Readings {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        match self {
            Self::EulerAsVector => data.measurand = Measurand::DeflectionRotationVector,
            Self::VectorAsEuler => data.observations.iter_mut().for_each(to_vector),
        }
    }
}

fn to_vector(row: &mut Observation) {
    let [reference, loaded] = states(row);
    write(row, 3, &log(&(loaded * reference.transpose())));
}
