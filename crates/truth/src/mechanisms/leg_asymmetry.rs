//! Legs are softer when they pull: `leg-asymmetry`.
//!
//! Preloaded stacks and bolted flanges open under tension: another spring joins in series.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// Legs are softer when they pull.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegAsymmetry {
    /// Further compliance under tension `c_t`, m/N.
    pub tension_compliance: f64,
}

impl Registered for LegAsymmetry {
    const ID: &'static str = "leg-asymmetry";
    const TITLE: &'static str = "Legs are softer when they pull";
    const PHYSICS: &'static str = "e += c_t max(f, 0)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { tension_compliance: 5e-8 }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.tension_compliance += self.tension_compliance;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { tension_compliance: self.tension_compliance * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("asymmetry", json!(self.tension_compliance))]
    }
}
