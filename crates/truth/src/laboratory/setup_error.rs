//! Repeats of a condition share an error of the set-up: the load is put on once and read twice.
//!
//! `e = z + s u`, `u` Gaussian and the same for all repeats of a condition. Repeats agree better than they should.

use hexbench_core::Vector6;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};
use crate::campaign::PlanRow;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "setup-0.5" "repeats share a set-up error of 0.5 sigma", &["setup-error"] => SetupError { share: 0.5 };
];

/// An error of the set-up.
#[derive(Debug)]
struct SetupError {
    /// Its standard deviation over that of the noise.
    share: f64,
}

impl LaboratoryFault for SetupError {
    fn err(&self, rows: &[PlanRow], sigma: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        let mut common = Vector6::zeros();
        let mut errors = errors.iter_mut();
        for (i, error) in errors.by_ref().enumerate() {
            if i == 0 || rows[i].situation != rows[i - 1].situation {
                common = normal6(rng).component_mul(sigma) * self.share;
            }
            *error += common;
        }
    }
}
