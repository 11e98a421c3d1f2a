//! How noisy the instrument is.

use hexbench_core::files::{Fault, Item};
use hexbench_truth::metrology::InstrumentNoise;

/// Keys: times what is stated; standard deviations of one reading.
pub(crate) const KEYS: [&str; 2] = ["noise_scale", "noise_um_urad"];

/// Noise of one reading of a full pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ReadingNoise {
    /// Times the noise that is stated.
    Scale(f64),
    /// Standard deviations of one reading: translation (m), rotation (rad).
    Sigmas([f64; 2]),
}

impl ReadingNoise {
    /// The noise on an instrument that states some.
    pub fn of(self, stated: InstrumentNoise) -> InstrumentNoise {
        let [sigma_translation, sigma_rotation] = match self {
            Self::Scale(scale) => [stated.sigma_translation, stated.sigma_rotation].map(|s| s * scale),
            Self::Sigmas(sigmas) => sigmas,
        };
        InstrumentNoise { sigma_translation, sigma_rotation, ..stated }
    }

    /// By how much the noise that sensors state is scaled.
    pub fn scale(self) -> f64 {
        match self {
            Self::Scale(scale) => scale,
            Self::Sigmas(_) => 1.0,
        }
    }
}

/// A multiple of the stated noise.
pub(crate) fn scale(item: &Item<'_>) -> Result<f64, Fault> {
    item.positive("the scale of the noise")
}

/// Standard deviations of translation (um) and rotation (urad), in m and rad.
pub(crate) fn sigmas(item: &Item<'_>) -> Result<[f64; 2], Fault> {
    let pair = item.exactly::<2>("two standard deviations, translation (um) and rotation (urad)")?;
    Ok([pair[0].positive("a standard deviation")? * 1e-6, pair[1].positive("a standard deviation")? * 1e-6])
}
