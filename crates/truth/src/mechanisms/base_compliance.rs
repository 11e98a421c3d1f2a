//! The foundation yields: `base-compliance`.
//!
//! The base is a body of its own: it carries the reactions of the legs and rests on three springs along and three about
//! the fixed axes, at the mean of the base joints (height: the mounting plane when the drawing states it).

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, six_springs, vector};
use crate::{Instant, Setup};

/// The foundation yields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaseCompliance {
    /// Along x, y, z (N/m) and about x, y, z (N m/rad).
    pub stiffness: [f64; 6],
}

impl Registered for BaseCompliance {
    const ID: &'static str = "base-compliance";
    const TITLE: &'static str = "The foundation yields";
    const PHYSICS: &'static str = "base body on six springs at the center of the base-joint plane";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_N_PER_M: f64 = 2e8;
        let turning =
            USUAL_N_PER_M * hexapod.base_joints.iter().map(|a| a.xy().norm_squared()).sum::<f64>() / 6.0;
        Self { stiffness: six_springs(USUAL_N_PER_M, turning, rng) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_base(&Matrix6::from_diagonal(&vector(&self.stiffness.map(f64::recip))));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { stiffness: self.stiffness.map(|k| k / factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("base", json!(self.stiffness))]
    }
}
