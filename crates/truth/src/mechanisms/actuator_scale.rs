//! Encoders or lead screws have a gain error: `actuator-scale`.
//!
//! Lead error of the screw, scale of the encoder, or a warm scale; counted from the home length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal6};
use crate::{Instant, Setup};

/// Encoders or lead screws have a gain error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActuatorScale {
    /// Gain error of each leg, m/m.
    pub gains: [f64; 6],
}

impl Registered for ActuatorScale {
    const ID: &'static str = "actuator-scale";
    const TITLE: &'static str = "Encoders or lead screws have a gain error";
    const PHYSICS: &'static str = "q = q(commanded) + gain_i (q - q_home)";
    const SHOWS: Shows = Shows::Absolute;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL: f64 = 1e-3;
        Self { gains: normal6(rng, [USUAL; 2]) }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, length) in setup.leg_lengths.iter_mut().enumerate() {
            *length += self.gains[i] * (moment.nominal_lengths[i] - moment.home_lengths[i]);
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { gains: self.gains.map(|x| x * factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("actuator_scale", json!(self.gains))]
    }
}
