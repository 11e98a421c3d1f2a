//! Readings, loads or joints in axes that are not those of the machine.
//!
//! With `Q` from the axes of the machine to those of the author: `v -> Q v` for translations, forces and joints; `M -> det(Q) Q M` for
//! moments; `R -> Q R Q'` for the rotations of both states, whose Euler angles are then taken.

use hexbench_core::{Dataset, Hexapod, Matrix3, Observation, Vector3, Wrench};
use rand_pcg::Pcg64;

use super::rotations::{angles, states, translation, write};
use super::{Misstatement, MisstatementEntry};
use crate::so3::exp;

const AXES: &[&str] = &["axes"];
/// Axes of the joints only: the drawing is wrong, or its legs are numbered another way round.
const OF_JOINTS: &[&str] = &["axes", "geometry", "leg-order"];

const fn readings(turn: Turn) -> Turned {
    Turned { subject: Subject::Readings, turn }
}

const fn loads(turn: Turn) -> Turned {
    Turned { subject: Subject::Loads, turn }
}

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "readings-yaw-90" "Readings are in axes turned by 90 deg about z.", AXES => readings(YAW_90);
    Tables "readings-yaw-180" "Readings are in axes turned by 180 deg about z.", AXES => readings(YAW_180);
    Tables "readings-yaw-270" "Readings are in axes turned by -90 deg about z.", AXES => readings(YAW_270);
    Tables "readings-z-down" "Readings are in axes with z down.", AXES => readings(Z_DOWN);
    Tables "readings-left-handed" "Readings are in left-handed axes.", AXES => readings(MIRRORED);
    Tables "readings-yaw-5" "Readings are in axes turned by 5 deg about z.", AXES => readings(YAW_5);
    Tables "readings-yaw-2" "Readings are in axes turned by 2 deg about z.", AXES => readings(YAW_2);
    Tables "readings-tilt-2" "Readings are in axes tilted by 2 deg about x.", AXES => readings(TILT_2);
    Tables "readings-x-y-exchanged" "The columns of x and y are exchanged, in translations and rotations.",
        AXES => Exchanged { subject: Subject::Readings, pairs: &[(0, 1), (3, 4)] };
    Tables "translations-x-y-exchanged" "The columns of x and y are exchanged, in translations only.", AXES
        => Exchanged { subject: Subject::Readings, pairs: &[(0, 1)] };
    Tables "rotations-x-y-exchanged" "The columns of the rotations about x and y are exchanged, translations are as they should be.",
        AXES => Exchanged { subject: Subject::Readings, pairs: &[(3, 4)] };
    Tables "wrench-yaw-90" "Loads are in axes turned by 90 deg about z.", AXES => loads(YAW_90);
    Tables "wrench-yaw-180" "Loads are in axes turned by 180 deg about z.", AXES => loads(YAW_180);
    Tables "wrench-yaw-270" "Loads are in axes turned by -90 deg about z.", AXES => loads(YAW_270);
    Tables "wrench-z-down" "Loads are in axes with z down.", AXES => loads(Z_DOWN);
    Tables "wrench-left-handed" "Loads are in left-handed axes.", AXES => loads(MIRRORED);
    Tables "wrench-yaw-5" "Loads are in axes turned by 5 deg about z.", AXES => loads(YAW_5);
    Tables "wrench-tilt-2" "Loads are in axes tilted by 2 deg about x.", AXES
        => loads(TILT_2) => or_effects(&["load-tilt"]);
    Tables "wrench-x-y-exchanged" "The columns of x and y are exchanged, in forces and moments.", AXES
        => Exchanged { subject: Subject::Loads, pairs: &[(0, 1), (3, 4)] };
    Machine "joints-yaw-90" "All joints are in axes turned by 90 deg about z.", OF_JOINTS
        => TurnedJoints(YAW_90);
    Machine "joints-yaw-180" "All joints are in axes turned by 180 deg about z.", OF_JOINTS
        => TurnedJoints(YAW_180);
    Machine "joints-z-down" "All joints are in axes with z down.", OF_JOINTS => TurnedJoints(Z_DOWN);
    Machine "joints-left-handed" "All joints are in left-handed axes.", OF_JOINTS => TurnedJoints(MIRRORED);
    Machine "joints-yaw-5" "All joints are in axes turned by 5 deg about z.", OF_JOINTS
        => TurnedJoints(YAW_5);
];

const YAW_2: Turn = Turn::About(Axis::Z, 2.0);
const YAW_5: Turn = Turn::About(Axis::Z, 5.0);
const YAW_90: Turn = Turn::About(Axis::Z, 90.0);
const YAW_180: Turn = Turn::About(Axis::Z, 180.0);
const YAW_270: Turn = Turn::About(Axis::Z, -90.0);
const TILT_2: Turn = Turn::About(Axis::X, 2.0);
const Z_DOWN: Turn = Turn::About(Axis::X, 180.0);
const MIRRORED: Turn = Turn::Mirrored;

/// An axis.
#[derive(Debug, Clone, Copy)]
enum Axis {
    X,
    Z,
}

/// From the axes of the machine to those of the author.
#[derive(Debug, Clone, Copy)]
enum Turn {
    /// The author's axes are turned about an axis, deg.
    About(Axis, f64),
    /// Their y points the other way.
    Mirrored,
}

impl Turn {
    fn matrix(self) -> Matrix3 {
        match self {
            Self::About(axis, degrees) => {
                let axis = if matches!(axis, Axis::X) { Vector3::x() } else { Vector3::z() };
                exp(&(axis * -degrees.to_radians()))
            }
            Self::Mirrored => Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0)),
        }
    }
}

/// What is in other axes.
#[derive(Debug, Clone, Copy)]
enum Subject {
    Readings,
    Loads,
}

/// All joints in other axes.
#[derive(Debug)]
struct TurnedJoints(Turn);

impl Misstatement for TurnedJoints {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        let q = self.0.matrix();
        hexapod.base_joints = hexapod.base_joints.map(|a| q * a);
        hexapod.platform_joints = hexapod.platform_joints.map(|b| q * b);
    }
}

/// Readings or loads in other axes.
#[derive(Debug)]
struct Turned {
    subject: Subject,
    turn: Turn,
}

impl Misstatement for Turned {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        let q = self.turn.matrix();
        for row in &mut data.observations {
            match self.subject {
                Subject::Readings => turn_reading(row, &q),
                Subject::Loads => {
                    row.wrench = turned(&row.wrench, &q);
                    row.reference = turned(&row.reference, &q);
                }
            }
        }
    }
}

fn turn_reading(row: &mut Observation, q: &Matrix3) {
    let [before, after] = states(row).map(|r| angles(&(q * r * q.transpose())));
    let moved = q * translation(row);
    write(row, 0, &moved);
    write(row, 3, &(after - before));
}

fn turned(wrench: &Wrench, q: &Matrix3) -> Wrench {
    Wrench { force: q * wrench.force, moment: q * wrench.moment * q.determinant() }
}

/// Columns exchanged, pair by pair.
#[derive(Debug)]
struct Exchanged {
    subject: Subject,
    pairs: &'static [(usize, usize)],
}

impl Misstatement for Exchanged {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        let exchanged = |mut six: [f64; 6]| {
            self.pairs.iter().for_each(|&(one, other)| six.swap(one, other));
            six
        };
        for row in &mut data.observations {
            match self.subject {
                Subject::Readings => row.measured = exchanged(row.measured),
                Subject::Loads => {
                    row.wrench = Wrench::from_array(exchanged(row.wrench.to_array()));
                    row.reference = Wrench::from_array(exchanged(row.reference.to_array()));
                }
            }
        }
    }
}
