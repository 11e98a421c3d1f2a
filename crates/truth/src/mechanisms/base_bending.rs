//! The foundation bends as a full 6x6 compliance: `out:base-bending`.
//!
//! A real structure couples translation with rotation: its compliance is a full symmetric positive matrix at the center of the base-joint plane, fixed axes.
//! The same physics as `base-compliance`, in the form that six diagonal springs cannot take.

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, full_compliance};
use crate::{Instant, Setup};

/// The foundation bends as a full 6x6 compliance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaseBending {
    /// Symmetric, at the center of the base-joint plane, fixed axes; m/N, rad/N, rad/(N m).
    pub compliance: [[f64; 6]; 6],
}

impl Registered for BaseBending {
    const ID: &'static str = "out:base-bending";
    const TITLE: &'static str = "The foundation bends as a full 6x6 compliance";
    const PHYSICS: &'static str = "six springs along and about six skew axes instead of the frame's own";
    const SHOWS: Shows = Shows::Outside;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_N_PER_M: f64 = 2e8;
        let radius = hexapod.base_joints.iter().map(|a| a.xy().norm()).sum::<f64>() / 6.0;
        Self { compliance: full_compliance(USUAL_N_PER_M, radius, rng) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_base(&Matrix6::from_fn(|i, j| self.compliance[i][j]));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { compliance: self.compliance.map(|row| row.map(|x| x * factor)) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("base_compliance", json!(self.compliance))]
    }
}
