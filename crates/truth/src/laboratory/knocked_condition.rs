//! Someone knocks against the target: all readings of one pose under one load are shifted alike.
//!
//! `x -> x + s sigma u` with one direction `u` of unit length in the six whitened numbers.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6, pick};

/// Its entry in the registry. Repeats agree, so that a wrong load or pose explains them too.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "knocked-condition" "all readings of one condition knocked by 20 sigma", &["blunder", "load"]
        => KnockedCondition { sigmas: 20.0 };
];

/// A knock.
#[derive(Debug)]
struct KnockedCondition {
    /// Length of the shift in standard deviations.
    sigmas: f64,
}

impl LaboratoryFault for KnockedCondition {
    fn slip(&self, data: &mut Dataset, sigma: &Vector6, rng: &mut Pcg64) {
        let shift = (normal6(rng).normalize() * self.sigmas).component_mul(sigma);
        for row in pick::condition(data, rng) {
            for (value, by) in data.observations[row].measured.iter_mut().zip(shift.iter()) {
                *value += by;
            }
        }
    }
}
