//! The load acts away from the mobile origin: `load-offset`.
//!
//! The force of the wrench acts at `r'`, fixed to the platform, not at the mobile origin; its direction stays fixed in space.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal3};
use crate::{Instant, Setup, setup::PointForce};

/// The load acts away from the mobile origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadOffset {
    /// Where the force acts `r'`, mobile frame, m.
    pub point: [f64; 3],
}

impl Registered for LoadOffset {
    const ID: &'static str = "load-offset";
    const TITLE: &'static str = "The load acts away from the mobile origin";
    const PHYSICS: &'static str = "moment (R r') x F in both states";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_M: f64 = 3e-3;
        Self { point: normal3(rng, USUAL_M) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let force = setup.wrench.force;
        setup.wrench.force = Vector3::zeros();
        setup.forces.push(PointForce { point: self.point.into(), force });
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { point: self.point.map(|x| x * factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("cog", json!(self.point))]
    }
}
