//! One axis is noisier than the others, and the file states one standard deviation for all three.
//!
//! With `r` the ratio of z to x and y, `sigma_x = sigma sqrt(3 / (2 + r^2))` keeps the pooled variance as stated. Coordinate
//! measuring machines and trackers are worst along one axis.

use hexbench_core::Vector6;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};
use crate::campaign::PlanRow;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "uneven-axis-2.5x" "z 2.5 times noisier than x and y, pooled sigma stated", &["noise-level"]
        => UnevenAxis { ratio: 2.5 };
];

/// A noisy axis.
#[derive(Debug)]
struct UnevenAxis {
    /// Standard deviation of z over that of x and y.
    ratio: f64,
}

impl LaboratoryFault for UnevenAxis {
    fn err(&self, _: &[PlanRow], _: &Vector6, errors: &mut [Vector6], _: &mut Pcg64) {
        let others = (3.0 / (2.0 + self.ratio * self.ratio)).sqrt();
        for error in errors {
            for (k, factor) in [others, others, others * self.ratio].into_iter().enumerate() {
                error[k] *= factor;
            }
        }
    }
}
