//! One leg drifts with time: `out:leg-drift`.
//!
//! A servo amplifier warms up, or a hydraulic valve leaks.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed_if};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:leg-drift",
    title: "One leg drifts with time",
    physics: "q_i += rate * elapsed for one leg",
    shows: Shows::Outside,
    draw,
    parse: |value| parsed_if::<LegDrift>(value, |m| (1..=6).contains(&m.leg), "leg must be 1 to 6"),
};

/// One leg drifts with time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegDrift {
    /// Leg, from 1.
    pub leg: usize,
    /// Growth of its length, m/s.
    pub rate: f64,
}

impl Mechanism for LegDrift {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        setup.leg_lengths[self.leg - 1] += self.rate * moment.elapsed();
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { rate: self.rate * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("leg_drift".to_owned(), json!((self.leg, self.rate)))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegDrift { leg: one_of(rng, &[1, 2, 3, 4, 5, 6]), rate: 5e-9 })
}
