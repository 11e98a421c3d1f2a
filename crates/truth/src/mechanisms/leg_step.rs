//! One leg steps at some time: `out:leg-step`.
//!
//! A brake lets go, a gauge block slips: from some time on one leg is longer.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of, uniform};
use crate::{Instant, Setup};

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

impl Registered for LegStep {
    const ID: &'static str = "out:leg-step";
    const TITLE: &'static str = "One leg steps at some time";
    const PHYSICS: &'static str = "q_i += step for one leg once elapsed > time";
    const SHOWS: Shows = Shows::Outside;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        let time = uniform(rng, 60.0, 240.0);
        Self { leg: one_of(rng, &[1, 2, 3, 4, 5, 6]), step: 1e-6, time }
    }

    fn check(&self) -> Result<(), &'static str> {
        if (1..=6).contains(&self.leg) { Ok(()) } else { Err("leg must be 1 to 6") }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        if moment.elapsed() > self.time {
            setup.leg_lengths[self.leg - 1] += self.step;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { step: self.step * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("leg_step", json!((self.leg, self.step, self.time)))]
    }
}
