//! Leg compliance grows with the cube of the position: `out:cubic-compliance`.
//!
//! Guides or covers that bind towards one end of the travel.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed_if};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:cubic-compliance",
    title: "Leg compliance grows with the cube of the position",
    physics: "c_i = c (1 + growth (x / reach)^3), x = a or b",
    shows: Shows::Outside,
    draw,
    parse: |value| parsed_if::<CubicCompliance>(value, |m| m.axis < 2, "axis must be 0 (a) or 1 (b)"),
};

/// Leg compliance grows with the cube of the position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CubicCompliance {
    /// Relative growth at `reach`.
    pub growth: f64,
    /// Position at which it is counted, m.
    pub reach: f64,
    /// 0: a, 1: b.
    pub axis: usize,
}

impl Mechanism for CubicCompliance {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let x = moment.situation.pose.translation[self.axis] / self.reach;
        for law in &mut setup.laws {
            law.compliance *= 1.0 + self.growth * x.powi(3);
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { growth: self.growth * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("cubic_compliance".to_owned(), json!((self.growth, self.reach, self.axis)))])
    }
}

fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(CubicCompliance {
        growth: 0.1,
        reach: 0.25 * hexapod.platform_radius(),
        axis: one_of(rng, &[0, 1]),
    })
}
