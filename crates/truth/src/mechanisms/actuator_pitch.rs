//! Periodic lead error of the actuators: `actuator-pitch`.
//!
//! The screw or the encoder errs once a turn; all legs alike but for the phase. `q` is the commanded length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of, uniform};
use crate::{Instant, Setup};

/// Periodic lead error of the actuators.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActuatorPitch {
    /// Amplitude, m.
    pub amplitude: f64,
    /// Travel per period, m.
    pub pitch: f64,
    /// Phase of each leg, rad.
    pub phases: [f64; 6],
}

impl Registered for ActuatorPitch {
    const ID: &'static str = "actuator-pitch";
    const TITLE: &'static str = "Periodic lead error of the actuators";
    const PHYSICS: &'static str = "q = q(commanded) + amp sin(2 pi q / pitch + phase_i)";
    const SHOWS: Shows = Shows::Absolute;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        let pitch = one_of(rng, &[1e-3, 2e-3, 3e-3, 5e-3]);
        let phases = std::array::from_fn(|_| uniform(rng, 0.0, std::f64::consts::TAU));
        Self { amplitude: 6e-6, pitch, phases }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, length) in setup.leg_lengths.iter_mut().enumerate() {
            let turn = std::f64::consts::TAU * moment.nominal_lengths[i] / self.pitch;
            *length += self.amplitude * (turn + self.phases[i]).sin();
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { amplitude: self.amplitude * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("actuator_pitch", json!((self.amplitude, self.pitch, self.phases)))]
    }
}
