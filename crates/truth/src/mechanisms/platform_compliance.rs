//! The plate between legs and targets yields: `platform-compliance`.
//!
//! The legs hold one body, load and targets sit on another; six springs along and about the mobile axes join them at the
//! mobile origin.

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, six_springs, vector};
use crate::{Instant, Setup};

/// The plate between legs and targets yields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlatformCompliance {
    /// Along x', y', z' (N/m) and about x', y', z' (N m/rad).
    pub stiffness: [f64; 6],
}

impl Registered for PlatformCompliance {
    const ID: &'static str = "platform-compliance";
    const TITLE: &'static str = "The plate between legs and targets yields";
    const PHYSICS: &'static str =
        "legs' plate and measured platform joined by six springs at the mobile origin";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_N_PER_M: f64 = 3e8;
        let turning = USUAL_N_PER_M * hexapod.platform_radius().powi(2);
        Self { stiffness: six_springs(USUAL_N_PER_M, turning, rng) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_plate(&Matrix6::from_diagonal(&vector(&self.stiffness.map(f64::recip))));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { stiffness: self.stiffness.map(|k| k / factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("platform", json!(self.stiffness))]
    }
}
