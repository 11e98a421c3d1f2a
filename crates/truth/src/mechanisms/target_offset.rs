//! The measured point is not the mobile origin: `target-offset`.
//!
//! The origin of the measured targets sits at `r'` on the platform.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal3};
use crate::{Instant, equilibrium::Body};

/// The measured point is not the mobile origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetOffset {
    /// Measured point, mobile frame, m.
    pub point: [f64; 3],
}

impl Registered for TargetOffset {
    const ID: &'static str = "target-offset";
    const TITLE: &'static str = "The measured point is not the mobile origin";
    const PHYSICS: &'static str = "reading of t + R r'";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_M: f64 = 5e-3;
        Self { point: normal3(rng, USUAL_M) }
    }

    fn see(&self, _: &Instant<'_>, body: &mut Body) {
        body.origin += body.axes * Vector3::from(self.point);
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { point: self.point.map(|x| x * factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("target", json!(self.point))]
    }
}
