//! Periodic lead error of the actuators: `actuator-pitch`.
//!
//! The screw or the encoder errs once a turn; all legs alike but for the phase. `q` is the commanded length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed, uniform};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "actuator-pitch",
    title: "Periodic lead error of the actuators",
    physics: "q = q(commanded) + amp sin(2 pi q / pitch + phase_i)",
    shows: Shows::Absolute,
    draw,
    parse: parsed::<ActuatorPitch>,
};

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

impl Mechanism for ActuatorPitch {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, length) in setup.leg_lengths.iter_mut().enumerate() {
            let turn = std::f64::consts::TAU * moment.nominal_lengths[i] / self.pitch;
            *length += self.amplitude * (turn + self.phases[i]).sin();
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { amplitude: self.amplitude * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("actuator_pitch".to_owned(), json!((self.amplitude, self.pitch, self.phases)))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    let pitch = one_of(rng, &[1e-3, 2e-3, 3e-3, 5e-3]);
    let phases = std::array::from_fn(|_| uniform(rng, 0.0, std::f64::consts::TAU));
    Box::new(ActuatorPitch { amplitude: 6e-6, pitch, phases })
}
