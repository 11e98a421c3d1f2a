//! Legs grow with temperature: `thermal-expansion`.
//!
//! All legs are `delta_T` warmer at the loaded reading than at the reference reading.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// Legs grow with temperature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThermalExpansion {
    /// Expansion coefficient, 1/K.
    pub alpha: f64,
}

impl Registered for ThermalExpansion {
    const ID: &'static str = "thermal-expansion";
    const TITLE: &'static str = "Legs grow with temperature";
    const PHYSICS: &'static str = "q -> q (1 + alpha delta_T)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { alpha: 1.2e-5 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for length in &mut setup.leg_lengths {
            *length *= 1.0 + self.alpha * moment.delta_t();
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { alpha: self.alpha * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("alpha", json!(self.alpha))]
    }
}
