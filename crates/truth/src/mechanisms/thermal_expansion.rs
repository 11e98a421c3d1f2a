//! Legs grow with temperature: `thermal-expansion`.
//!
//! All legs are `delta_T` warmer at the loaded reading than at the reference reading.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "thermal-expansion",
    title: "Legs grow with temperature",
    physics: "q -> q (1 + alpha delta_T)",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<ThermalExpansion>,
};

/// Legs grow with temperature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThermalExpansion {
    /// Expansion coefficient, 1/K.
    pub alpha: f64,
}

impl Mechanism for ThermalExpansion {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for length in &mut setup.leg_lengths {
            *length *= 1.0 + self.alpha * moment.delta_t();
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { alpha: self.alpha * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("alpha".to_owned(), json!(self.alpha))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(ThermalExpansion { alpha: 1.2e-5 })
}
