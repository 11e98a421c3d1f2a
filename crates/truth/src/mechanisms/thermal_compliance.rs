//! Leg compliance changes with temperature: `out:thermal-compliance`.
//!
//! A preload that grows or fades with temperature.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:thermal-compliance",
    title: "Leg compliance changes with temperature",
    physics: "c_i = c (1 + beta delta_T) in the loaded state",
    shows: Shows::Outside,
    draw,
    parse: parsed::<ThermalCompliance>,
};

/// Leg compliance changes with temperature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThermalCompliance {
    /// Relative growth of the compliance, 1/K.
    pub beta: f64,
}

impl Mechanism for ThermalCompliance {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.compliance *= 1.0 + self.beta * moment.delta_t();
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { beta: self.beta * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("thermal_compliance".to_owned(), json!(self.beta))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(ThermalCompliance { beta: 0.05 })
}
