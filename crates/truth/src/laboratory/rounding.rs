//! Values are written with few digits.
//!
//! `x -> q round(x / q)`: an error of up to `q / 2`, with the standard deviation `q / sqrt(12)` where the noise is wider than `q`.
//!
//! Source: Widrow, Kollar 2008, Quantization Noise.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};

/// Its sizes in the registry: small beside the usual noise, and larger than it.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "rounded-0.1um" "rounded to 0.1 um and 1 urad", &["resolution"] => Rounding { length: 1e-7, angle: 1e-6 };
    "rounded-1um" "rounded to 1 um and 10 urad", &["resolution", "noise-level"]
        => Rounding { length: 1e-6, angle: 1e-5 };
];

/// A step of the written values.
#[derive(Debug)]
struct Rounding {
    /// Of translations, m.
    length: f64,
    /// Of rotations, rad.
    angle: f64,
}

impl LaboratoryFault for Rounding {
    fn write(&self, data: &mut Dataset, _: &mut Pcg64) {
        for observation in &mut data.observations {
            for (k, value) in observation.measured.iter_mut().enumerate() {
                let step = if k < 3 { self.length } else { self.angle };
                *value = (*value / step).round() * step;
            }
        }
    }
}
