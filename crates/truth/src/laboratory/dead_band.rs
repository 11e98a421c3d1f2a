//! The instrument does not show all of a motion: it sticks at zero, or its mechanism has play.
//!
//! ```text
//! sticks   r = sign(x) max(|x| - d, 0)
//! play     r = s(x) - s(0),  s(x) = the old s, or the nearest number within d of x: the reference is read before every load
//! ```
//!
//! Source: Krasnosel'skii, Pokrovskii 1989, Systems with Hysteresis (the play operator).

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};

/// Half of the dead band of the translations, m.
const HALF: f64 = 1e-6;

/// Its ways in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "gauges-stick-1um" "translations fall short by 1 um: gauges stick at zero", &["dead-band"]
        => DeadBand { has_play: false };
    "gauges-play-1um" "translations are read with a play of 1 um to either side", &["dead-band"]
        => DeadBand { has_play: true };
];

/// An instrument that does not show all of a motion.
#[derive(Debug)]
struct DeadBand {
    /// It goes on from where it was; else it rests at zero before every reading.
    has_play: bool,
}

impl LaboratoryFault for DeadBand {
    fn write(&self, data: &mut Dataset, _: &mut Pcg64) {
        for k in 0..3 {
            let mut shown = 0.0_f64;
            for observation in &mut data.observations {
                let reference = if self.has_play { shown.clamp(-HALF, HALF) } else { 0.0 };
                let moved = observation.measured[k];
                shown = reference.clamp(moved - HALF, moved + HALF);
                observation.measured[k] = shown - reference;
            }
        }
    }
}
