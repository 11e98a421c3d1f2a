//! The six errors of a reading resemble each other: a target that is not held still moves in all coordinates at once.
//!
//! `e_k = sigma_k (sqrt(rho) c + sqrt(1 - rho) z_k)`, `c` common to the six: every pair correlates by `rho`, every standard
//! deviation is as stated.

use hexbench_core::Vector6;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};
use crate::campaign::PlanRow;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "correlated-0.8" "errors of the six coordinates correlate by 0.8", &["noise-level"]
        => Correlated { rho: 0.8 };
];

/// Correlated coordinates.
#[derive(Debug)]
struct Correlated {
    /// Correlation of any two.
    rho: f64,
}

impl LaboratoryFault for Correlated {
    fn err(&self, _: &[PlanRow], sigma: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        for error in errors {
            let common: f64 = StandardNormal.sample(rng);
            *error = *error * (1.0 - self.rho).sqrt() + sigma * (self.rho.sqrt() * common);
        }
    }
}
