//! Legs have weight: `leg-weight`.
//!
//! A uniform leg pinned at both ends puts half its weight on either joint, whatever its inclination; its axial force then runs
//! from f - m g `n_z` / 2 below to f + m g `n_z` / 2 above, with mean f, and stretches it by c f. Gravity along -z.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// Legs have weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegWeight {
    /// Mass of each leg, kg.
    pub mass: f64,
}

impl Registered for LegWeight {
    const ID: &'static str = "leg-weight";
    const TITLE: &'static str = "Legs have weight";
    const PHYSICS: &'static str = "half of m g on each joint; f is the mean axial force";
    const SHOWS: Shows = Shows::Absolute;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { mass: 2.0 }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        const GRAVITY_M_PER_S2: f64 = 9.81;
        for weight in &mut setup.joint_weights {
            weight.z -= 0.5 * self.mass * GRAVITY_M_PER_S2;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("leg_weight", json!(self.mass))]
    }
}
