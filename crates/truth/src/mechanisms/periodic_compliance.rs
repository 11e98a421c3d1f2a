//! Leg compliance periodic in leg length: `out:periodic-compliance`.
//!
//! Balls entering and leaving a recirculating nut, or a screw supported at intervals. `q` is the present length.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed};
use crate::{Instant, Setup, law::LengthCompliance};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:periodic-compliance",
    title: "Leg compliance periodic in leg length",
    physics: "c_i = c + amp sin(2 pi q / pitch)",
    shows: Shows::Outside,
    draw,
    parse: parsed::<PeriodicCompliance>,
};

/// Leg compliance periodic in leg length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodicCompliance {
    /// Amplitude, m/N.
    pub amplitude: f64,
    /// Travel per period, m.
    pub pitch: f64,
}

impl Mechanism for PeriodicCompliance {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.along_length
                .push(LengthCompliance::Periodic { amplitude: self.amplitude, pitch: self.pitch });
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { amplitude: self.amplitude * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("periodic_compliance".to_owned(), json!([self.amplitude, self.pitch]))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(PeriodicCompliance { amplitude: 1e-8, pitch: one_of(rng, &[4e-3, 5e-3, 8e-3, 12e-3]) })
}
