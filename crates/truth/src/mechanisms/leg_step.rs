//! One leg steps at some time: `out:leg-step`.
//!
//! A brake lets go, a gauge block slips: from some time on one leg is longer.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed_if, uniform};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:leg-step",
    title: "One leg steps at some time",
    physics: "q_i += step for one leg once elapsed > time",
    shows: Shows::Outside,
    draw,
    parse: |value| parsed_if::<LegStep>(value, |m| (1..=6).contains(&m.leg), "leg must be 1 to 6"),
};

/// One leg steps at some time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegStep {
    /// Leg, from 1.
    pub leg: usize,
    /// Growth of its length, m.
    pub step: f64,
    /// When, s after the reference reading.
    pub time: f64,
}

impl Mechanism for LegStep {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        if moment.elapsed() > self.time {
            setup.leg_lengths[self.leg - 1] += self.step;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { step: self.step * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("leg_step".to_owned(), json!((self.leg, self.step, self.time)))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    let time = uniform(rng, 60.0, 240.0);
    Box::new(LegStep { leg: one_of(rng, &[1, 2, 3, 4, 5, 6]), step: 1e-6, time })
}
