//! The stated standard deviation is not that of the readings.
//!
//! The readings stay; the file states `sigma / factor`. Data sheets state what an instrument does on a granite table.

use hexbench_core::Metrology;

use super::{FaultEntry, LaboratoryFault};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "noise-1.05x" "noise 1.05 times the stated", &["noise-level"] => StatedSigma { factor: 1.05 };
    "noise-1.1x" "noise 1.1 times the stated", &["noise-level"] => StatedSigma { factor: 1.1 };
    "noise-1.2x" "noise 1.2 times the stated", &["noise-level"] => StatedSigma { factor: 1.2 };
    "noise-1.3x" "noise 1.3 times the stated", &["noise-level"] => StatedSigma { factor: 1.3 };
    "noise-2x" "noise twice the stated", &["noise-level"] => StatedSigma { factor: 2.0 };
    "noise-0.5x" "noise half the stated", &["noise-level"] => StatedSigma { factor: 0.5 };
];

/// Noise that is not as stated.
#[derive(Debug)]
struct StatedSigma {
    /// True over stated standard deviation.
    factor: f64,
}

impl LaboratoryFault for StatedSigma {
    fn state(&self, metrology: &mut Metrology) {
        metrology.sigma_translation /= self.factor;
        metrology.sigma_rotation /= self.factor;
    }
}
