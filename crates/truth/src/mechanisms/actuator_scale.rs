//! Encoders or lead screws have a gain error: `actuator-scale`.
//!
//! Lead error of the screw, scale of the encoder, or a warm scale; counted from the home length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "actuator-scale",
    title: "Encoders or lead screws have a gain error",
    physics: "q = q(commanded) + gain_i (q - q_home)",
    shows: Shows::Absolute,
    draw,
    parse: parsed::<ActuatorScale>,
};

/// Encoders or lead screws have a gain error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActuatorScale {
    /// Gain error of each leg, m/m.
    pub gains: [f64; 6],
}

impl Mechanism for ActuatorScale {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, length) in setup.leg_lengths.iter_mut().enumerate() {
            *length += self.gains[i] * (moment.nominal_lengths[i] - moment.home_lengths[i]);
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { gains: self.gains.map(|x| x * factor) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("actuator_scale".to_owned(), json!(self.gains))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL: f64 = 1e-3;
    let ([a, b, c], [d, e, f]) = (normal3(rng, USUAL), normal3(rng, USUAL));
    Box::new(ActuatorScale { gains: [a, b, c, d, e, f] })
}
