//! The arm at which forces make a moment is not as long as the file says: all moments are off alike.
//!
//! `M -> M (1 + g)`; a plan without moments does not notice.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "moment-arm-1" "moment arm 1 % off", &["tolerance"] => MomentArm { gain: 0.01 };
    "moment-arm-3" "moment arm 3 % off", &["tolerance"] => MomentArm { gain: 0.03 };
];

/// A wrong arm.
#[derive(Debug)]
struct MomentArm {
    /// Relative error of what is written.
    gain: f64,
}

impl LaboratoryFault for MomentArm {
    fn write(&self, data: &mut Dataset, _: &mut Pcg64) {
        for o in &mut data.observations {
            o.wrench.moment *= 1.0 + self.gain;
            o.reference.moment *= 1.0 + self.gain;
        }
    }
}
