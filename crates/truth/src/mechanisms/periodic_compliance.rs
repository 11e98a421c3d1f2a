//! Leg compliance periodic in leg length: `out:periodic-compliance`.
//!
//! Balls entering and leaving a recirculating nut, or a screw supported at intervals. `q` is the present length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Setup, law::LengthCompliance};

/// Leg compliance periodic in leg length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodicCompliance {
    /// Amplitude, m/N.
    pub amplitude: f64,
    /// Travel per period, m.
    pub pitch: f64,
}

impl Registered for PeriodicCompliance {
    const ID: &'static str = "out:periodic-compliance";
    const TITLE: &'static str = "Leg compliance periodic in leg length";
    const PHYSICS: &'static str = "c_i = c + amp sin(2 pi q / pitch)";
    const SHOWS: Shows = Shows::Outside;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        Self { amplitude: 1e-8, pitch: one_of(rng, &[4e-3, 5e-3, 8e-3, 12e-3]) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.along_length
                .push(LengthCompliance::Periodic { amplitude: self.amplitude, pitch: self.pitch });
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { amplitude: self.amplitude * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("periodic_compliance", json!([self.amplitude, self.pitch]))]
    }
}
