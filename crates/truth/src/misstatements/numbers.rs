//! Which numbers of a row are written differently, and the commonest way: times a factor.

use hexbench_core::{Dataset, Hexapod, Observation, Pose, Wrench};
use rand_pcg::Pcg64;

use super::Misstatement;

/// The first three of six numbers.
pub(super) const FIRST: &[usize] = &[0, 1, 2];
/// The last three.
pub(super) const LAST: &[usize] = &[3, 4, 5];
/// All six.
pub(super) const ALL: &[usize] = &[0, 1, 2, 3, 4, 5];

/// Some of the six numbers of a reading, a load or a pose.
#[derive(Debug, Clone, Copy)]
pub(super) enum Numbers {
    /// Measured values.
    Reading(&'static [usize]),
    /// Wrench in the loaded and in the reference state.
    Load(&'static [usize]),
    /// Wrench in the reference state.
    Reference(&'static [usize]),
    /// Commanded pose.
    Pose(&'static [usize]),
}

impl Numbers {
    /// Changes each of them in a row.
    pub(super) fn change(self, row: &mut Observation, to: impl Fn(f64) -> f64) {
        let changed = |mut six: [f64; 6], places: &[usize]| {
            for &k in places {
                six[k] = to(six[k]);
            }
            six
        };
        match self {
            Self::Reading(places) => row.measured = changed(row.measured, places),
            Self::Load(places) => {
                row.wrench = Wrench::from_array(changed(row.wrench.to_array(), places));
                row.reference = Wrench::from_array(changed(row.reference.to_array(), places));
            }
            Self::Reference(places) => {
                row.reference = Wrench::from_array(changed(row.reference.to_array(), places));
            }
            Self::Pose(places) => row.pose = Pose::from_array(changed(row.pose.to_array(), places)),
        }
    }
}

/// `x -> factor x`: another unit, another sign.
#[derive(Debug)]
pub(super) struct Scaled {
    /// What is written so.
    pub(super) numbers: Numbers,
    /// Written over meant.
    pub(super) factor: f64,
}

/// Numbers times a factor.
pub(super) const fn scaled(numbers: Numbers, factor: f64) -> Scaled {
    Scaled { numbers, factor }
}

impl Misstatement for Scaled {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            self.numbers.change(row, |x| x * self.factor);
        }
    }
}
