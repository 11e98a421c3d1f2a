//! Legs have weight: `leg-weight`.
//!
//! A uniform leg pinned at both ends puts half its weight on either joint, whatever its inclination; its axial force then runs
//! from f - m g `n_z` / 2 below to f + m g `n_z` / 2 above, with mean f, and stretches it by c f. Gravity along -z.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-weight",
    title: "Legs have weight",
    physics: "half of m g on each joint; f is the mean axial force",
    shows: Shows::Absolute,
    draw,
    parse: parsed::<LegWeight>,
};

/// Legs have weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegWeight {
    /// Mass of each leg, kg.
    pub mass: f64,
}

impl Mechanism for LegWeight {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        const GRAVITY_M_PER_S2: f64 = 9.81;
        for weight in &mut setup.joint_weights {
            weight.z -= 0.5 * self.mass * GRAVITY_M_PER_S2;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { mass: self.mass * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("leg_weight".to_owned(), json!(self.mass))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegWeight { mass: 2.0 })
}
