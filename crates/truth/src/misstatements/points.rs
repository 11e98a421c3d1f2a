//! Another point than the mobile origin: of moments, of readings, of commanded poses.

use hexbench_core::{Dataset, Hexapod, Observation, Vector3, Wrench};
use rand_pcg::Pcg64;

use super::rotations::{states, translation, write};
use super::{Misstatement, MisstatementEntry};

/// How far the other point of the platform lies above the mobile origin, m.
const HEIGHT_M: f64 = 0.04;

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "moments-about-fixed-origin" "Moments are about the origin of the fixed frame.",
        &["origin", "wrench-frame"] => Moments::FixedOrigin;
    Tables "moments-about-base-center" "Moments are about the center of the base joints.",
        &["origin", "wrench-frame"] => Moments::BaseCenter => or_effects(&["load-offset"]);
    Tables "moments-about-load-cell" "Moments are about a load cell 40 mm above the mobile origin.",
        &["origin", "wrench-frame"] => Moments::LoadCell => or_effects(&["load-offset"]);
    Tables "readings-of-another-point" "Readings are of a point 40 mm above the mobile origin.", &["origin"]
        => OtherPoint::Readings => or_effects(&["target-offset"]);
    Tables "poses-of-another-point" "Commanded poses are those of a tool 40 mm above the mobile origin.",
        &["origin"] => OtherPoint::Poses;
];

fn above() -> Vector3 {
    Vector3::z() * HEIGHT_M
}

/// What moments are about.
#[derive(Debug)]
enum Moments {
    FixedOrigin,
    BaseCenter,
    LoadCell,
}

impl Moments {
    /// From the point the moments are about to the mobile origin, fixed axes, m.
    fn arm(&self, row: &Observation, hexapod: &Hexapod) -> Vector3 {
        match self {
            Self::FixedOrigin => row.pose.translation,
            Self::BaseCenter => row.pose.translation - hexapod.base_centre(),
            Self::LoadCell => -(row.pose.rotation() * above()),
        }
    }
}

impl Misstatement for Moments {
    fn write(&self, data: &mut Dataset, hexapod: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            let arm = self.arm(row, hexapod);
            let about = |w: &Wrench| Wrench { force: w.force, moment: w.moment + arm.cross(&w.force) };
            row.wrench = about(&row.wrench);
            row.reference = about(&row.reference);
        }
    }
}

/// What is of another point.
#[derive(Debug)]
enum OtherPoint {
    Readings,
    Poses,
}

impl Misstatement for OtherPoint {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            match self {
                Self::Readings => {
                    let [reference, loaded] = states(row);
                    let moved = translation(row) + (loaded - reference) * above();
                    write(row, 0, &moved);
                }
                Self::Poses => row.pose.translation += row.pose.rotation() * above(),
            }
        }
    }
}
