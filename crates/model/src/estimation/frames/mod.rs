//! Frames: the machine relative to the instrument, and the target relative to the platform.
//!
//! An absolute reading is `Y = M X T`: `X` the pose of the platform, `M` the fixed frame of the machine seen from the instrument,
//! `T` the target seen from the mobile frame. Both frames depend on how the instrument was set up: any rotation, meters away. A
//! fit moves them by small steps, so it has to start near them; [`Frames::between`] finds that start from the commanded poses in
//! closed form.

mod axes;
mod closed_form;

use hexbench_core::statistics::median;
use hexbench_core::{Hexapod, Observation, Pose};
use nalgebra::Isometry3;

pub use self::axes::ReadingAxes;
use self::closed_form::aligned;
use crate::machine::geometry::{Machine, isometry, pose};
use crate::machine::kinematics::leg_lengths;

/// Readings this near to what was commanded (share of a leg length, rad) need no other start than frames that coincide.
const NEAR: f64 = 0.01;
/// Readings do not follow the commanded poses when more than this share of what was commanded is left ...
const LEFT_SHARE: f64 = 0.3;
/// ... and more than this share of a leg length, or this angle in rad: a machine is built and driven better than that.
const LEFT: f64 = 0.02;

/// Frames of an instrument that reads absolute poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frames {
    /// `M`: fixed frame of the machine seen from the metrology frame.
    pub metrology: Isometry3<f64>,
    /// `T`: target frame seen from the mobile frame.
    pub target: Isometry3<f64>,
}

impl Default for Frames {
    /// Frames that coincide with those of the machine.
    fn default() -> Self {
        Self { metrology: Isometry3::identity(), target: Isometry3::identity() }
    }
}

/// Pose commanded and pose measured.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pair {
    commanded: Isometry3<f64>,
    measured: Isometry3<f64>,
}

/// How far measured poses are from the commanded ones, medians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// m.
    pub translation: f64,
    /// rad.
    pub rotation: f64,
}

impl Frames {
    /// Those a machine believes in.
    pub fn of(machine: &Machine) -> Self {
        Self { metrology: machine.metrology_frame, target: machine.target_frame }
    }

    /// Frames that carry the commanded poses of most rows to the measured ones; those of the machine where the readings are
    /// near to what was commanded anyway.
    ///
    /// Limits: deflections and errors of the machine are left out, so this is a start for a fit and no result.
    pub fn between(hexapod: &Hexapod, rows: &[Observation]) -> Self {
        let lever = lever(hexapod);
        let pairs = pairs(rows);
        let here = Self::default().departures(&pairs);
        if here.translation < NEAR * lever && here.rotation < NEAR {
            return Self::default();
        }
        Self::of_pairs(&pairs, lever)
    }

    /// Those that carry the commanded poses of most rows nearest to the measured ones, however near these are without.
    pub(crate) fn closest(hexapod: &Hexapod, rows: &[Observation]) -> Self {
        Self::of_pairs(&pairs(rows), lever(hexapod))
    }

    fn of_pairs(pairs: &[Pair], lever: f64) -> Self {
        let found = aligned(pairs, lever);
        if found.is_finite() { found } else { Self::default() }
    }

    /// How far one reading is from the commanded pose seen through these frames.
    pub(crate) fn departure_at(&self, row: &Observation) -> Departure {
        self.departure_of(&pair(row))
    }

    /// The platform behind a reading.
    pub(crate) fn platform(&self, reading: &[f64; 6]) -> Isometry3<f64> {
        self.metrology.inverse() * isometry(&Pose::from_array(*reading)) * self.target.inverse()
    }

    /// How far the readings are from the commanded poses seen through these frames.
    pub fn departure(&self, rows: &[Observation]) -> Departure {
        self.departures(&pairs(rows))
    }

    /// How far they are when they do not follow the commanded poses at all: another unit, other axes, other angles.
    pub fn astray(&self, hexapod: &Hexapod, rows: &[Observation]) -> Option<Departure> {
        let left = self.departure(rows);
        let spread = spread(rows);
        let far = |left: f64, spread: f64, unit: f64| {
            left.is_nan() || left > (LEFT_SHARE * spread).max(LEFT * unit)
        };
        let lost = far(left.translation, spread.translation, lever(hexapod))
            || far(left.rotation, spread.rotation, 1.0);
        lost.then_some(left)
    }

    /// The reading an instrument would give of a platform pose.
    pub fn seen(&self, platform: &Pose) -> Pose {
        if *self == Self::default() {
            *platform
        } else {
            pose(&(self.metrology * isometry(platform) * self.target))
        }
    }

    /// True when axes of the instrument or of the target are not those of the machine.
    fn are_turned(&self) -> bool {
        [self.metrology, self.target].iter().any(|f| f.rotation.angle() >= NEAR)
    }

    fn departures(&self, pairs: &[Pair]) -> Departure {
        let left: Vec<Departure> = pairs.iter().map(|p| self.departure_of(p)).collect();
        medians(&left)
    }

    fn departure_of(&self, pair: &Pair) -> Departure {
        apart(&(self.metrology * pair.commanded * self.target), &pair.measured)
    }

    fn is_finite(&self) -> bool {
        let all = [self.metrology, self.target];
        all.iter().all(|f| f.to_homogeneous().iter().all(|x| x.is_finite()))
    }
}

fn apart(a: &Isometry3<f64>, b: &Isometry3<f64>) -> Departure {
    let translation = (a.translation.vector - b.translation.vector).norm();
    Departure { translation, rotation: a.rotation.angle_to(&b.rotation) }
}

fn medians(all: &[Departure]) -> Departure {
    Departure {
        translation: median(all.iter().map(|d| d.translation)).unwrap_or(0.0),
        rotation: median(all.iter().map(|d| d.rotation)).unwrap_or(0.0),
    }
}

/// How far commanded poses are from the one in the middle of the file, medians.
fn spread(rows: &[Observation]) -> Departure {
    let Some(middle) = rows.get(rows.len() / 2).map(|o| isometry(&o.pose)) else { return medians(&[]) };
    let all: Vec<Departure> = rows.iter().map(|o| apart(&isometry(&o.pose), &middle)).collect();
    medians(&all)
}

fn pairs(rows: &[Observation]) -> Vec<Pair> {
    rows.iter().map(pair).collect()
}

fn pair(row: &Observation) -> Pair {
    Pair { commanded: isometry(&row.pose), measured: isometry(&Pose::from_array(row.measured)) }
}

/// Length that makes a rotation comparable with a translation: the mean leg at the zero pose, m.
pub(crate) fn lever(hexapod: &Hexapod) -> f64 {
    leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, &Pose::default()).mean().max(1e-6)
}
