//! Leg compliance changes with temperature: `out:thermal-compliance`.
//!
//! A preload that grows or fades with temperature.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// Leg compliance changes with temperature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThermalCompliance {
    /// Relative growth of the compliance, 1/K.
    pub beta: f64,
}

impl Registered for ThermalCompliance {
    const ID: &'static str = "out:thermal-compliance";
    const TITLE: &'static str = "Leg compliance changes with temperature";
    const PHYSICS: &'static str = "c_i = c (1 + beta delta_T) in the loaded state";
    const SHOWS: Shows = Shows::Outside;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { beta: 0.05 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.compliance *= 1.0 + self.beta * moment.delta_t();
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { beta: self.beta * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("thermal_compliance", json!(self.beta))]
    }
}
