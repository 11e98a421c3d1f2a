//! Legs are softer when they pull: `leg-asymmetry`.
//!
//! Preloaded stacks and bolted flanges open under tension: another spring joins in series.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-asymmetry",
    title: "Legs are softer when they pull",
    physics: "e += c_t max(f, 0)",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LegAsymmetry>,
};

/// Legs are softer when they pull.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegAsymmetry {
    /// Further compliance under tension `c_t`, m/N.
    pub tension_compliance: f64,
}

impl Mechanism for LegAsymmetry {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.tension_compliance += self.tension_compliance;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { tension_compliance: self.tension_compliance * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("asymmetry".to_owned(), json!(self.tension_compliance))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegAsymmetry { tension_compliance: 5e-8 })
}
