//! One leg drifts with time: `out:leg-drift`.
//!
//! A servo amplifier warms up, or a hydraulic valve leaks.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Setup};

/// One leg drifts with time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegDrift {
    /// Leg, from 1.
    pub leg: usize,
    /// Growth of its length, m/s.
    pub rate: f64,
}

impl Registered for LegDrift {
    const ID: &'static str = "out:leg-drift";
    const TITLE: &'static str = "One leg drifts with time";
    const PHYSICS: &'static str = "q_i += rate * elapsed for one leg";
    const SHOWS: Shows = Shows::Outside;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        Self { leg: one_of(rng, &[1, 2, 3, 4, 5, 6]), rate: 5e-9 }
    }

    fn check(&self) -> Result<(), &'static str> {
        if (1..=6).contains(&self.leg) { Ok(()) } else { Err("leg must be 1 to 6") }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        setup.leg_lengths[self.leg - 1] += self.rate * moment.elapsed();
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { rate: self.rate * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("leg_drift", json!((self.leg, self.rate)))]
    }
}
