//! The sign of one number was lost.
//!
//! It hits a number of at least [`LEAST`] standard deviations, so that it is off by twice as many.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Smallest number hit, standard deviations.
const LEAST: f64 = 10.0;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "sign-slip" "the sign of one number lost", &["blunder"] => SignSlip;
];

/// A lost sign.
#[derive(Debug)]
struct SignSlip;

impl LaboratoryFault for SignSlip {
    fn slip(&self, data: &mut Dataset, sigma: &Vector6, rng: &mut Pcg64) {
        if let Some((row, k)) = pick::number(data, 0..6, LEAST, sigma, rng) {
            data.observations[row].measured[k] *= -1.0;
        }
    }
}
