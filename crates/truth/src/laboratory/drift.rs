//! The zero of the instrument wanders along the file: room temperature, warming electronics.
//!
//! `d_i = rho d_(i-1) + s sqrt(1 - rho^2) z_i` for every number, stationary with standard deviation `s`, added to the noise.
//!
//! Source: Box, Jenkins 1970, Time Series Analysis (AR(1)).

use hexbench_core::Vector6;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};
use crate::campaign::PlanRow;

/// Correlation from one row to the next.
const RHO: f64 = 0.97;

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "drift-0.5" "drift of 0.5 sigma along the file (AR 0.97)", &["drift"] => Drift { share: 0.5 };
    "drift-1" "drift of 1 sigma along the file (AR 0.97)", &["drift"] => Drift { share: 1.0 };
];

/// A wandering zero.
#[derive(Debug)]
struct Drift {
    /// Its standard deviation over that of the noise.
    share: f64,
}

impl LaboratoryFault for Drift {
    fn err(&self, _: &[PlanRow], sigma: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        let mut wandered = normal6(rng);
        for error in errors {
            *error += wandered.component_mul(sigma) * self.share;
            wandered = wandered * RHO + normal6(rng) * (1.0 - RHO * RHO).sqrt();
        }
    }
}
