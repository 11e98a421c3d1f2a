//! Errors follow Student's t with three degrees of freedom: most are small, some are very large.
//!
//! `t = z / sqrt(c / 3)`, `z` the Gaussian error and `c` a chi-square of three degrees, one for each number. Its variance is
//! three times that of `z`: with the scale as stated the readings scatter more, with the variance as stated the middle is narrower.
//!
//! Source: Student 1908, Biometrika 6; Lange, Little, Taylor 1989, JASA 84 (measurements have such tails).

use hexbench_core::Vector6;
use rand_distr::{ChiSquared, Distribution};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};
use crate::campaign::PlanRow;

/// Degrees of freedom.
const DOF: f64 = 3.0;

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "student-3-variance" "Student noise, 3 degrees, variance as stated", &["heavy-tails"]
        => HeavyTails { keeps_variance: true };
    "student-3-scale" "Student noise, 3 degrees, scale as stated", &["heavy-tails"]
        => HeavyTails { keeps_variance: false };
];

/// Student's t in place of a Gaussian.
#[derive(Debug)]
struct HeavyTails {
    /// True when the variance is as stated, else the scale is.
    keeps_variance: bool,
}

impl LaboratoryFault for HeavyTails {
    fn err(&self, _: &[PlanRow], _: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        // A chi-square of three degrees always exists.
        let Ok(chi_squared) = ChiSquared::new(DOF) else { return };
        let scale = if self.keeps_variance { ((DOF - 2.0) / DOF).sqrt() } else { 1.0 };
        for value in errors.iter_mut().flat_map(|e| e.iter_mut()) {
            *value *= scale / (chi_squared.sample(rng) / DOF).sqrt();
        }
    }
}
