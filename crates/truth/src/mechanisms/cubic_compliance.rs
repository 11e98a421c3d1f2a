//! Leg compliance grows with the cube of the position: `out:cubic-compliance`.
//!
//! Guides or covers that bind towards one end of the travel.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Setup};

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

impl Registered for CubicCompliance {
    const ID: &'static str = "out:cubic-compliance";
    const TITLE: &'static str = "Leg compliance grows with the cube of the position";
    const PHYSICS: &'static str = "c_i = c (1 + growth (x / reach)^3), x = a or b";
    const SHOWS: Shows = Shows::Outside;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        Self { growth: 0.1, reach: 0.25 * hexapod.platform_radius(), axis: one_of(rng, &[0, 1]) }
    }

    fn check(&self) -> Result<(), &'static str> {
        if self.axis < 2 { Ok(()) } else { Err("axis must be 0 (a) or 1 (b)") }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let x = moment.situation.pose.translation[self.axis] / self.reach;
        for law in &mut setup.laws {
            law.compliance *= 1.0 + self.growth * x.powi(3);
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { growth: self.growth * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("cubic_compliance", json!((self.growth, self.reach, self.axis)))]
    }
}
