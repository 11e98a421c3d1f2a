//! The plate bends as a full 6x6 compliance: `out:plate-bending`.
//!
//! A real structure couples translation with rotation: its compliance is a full symmetric positive matrix at the mobile origin, mobile axes.
//! The same physics as `platform-compliance`, in the form that six diagonal springs cannot take.

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, full_compliance};
use crate::{Instant, Setup};

/// The plate bends as a full 6x6 compliance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlateBending {
    /// Symmetric, at the mobile origin, mobile axes; m/N, rad/N, rad/(N m).
    pub compliance: [[f64; 6]; 6],
}

impl Registered for PlateBending {
    const ID: &'static str = "out:plate-bending";
    const TITLE: &'static str = "The plate bends as a full 6x6 compliance";
    const PHYSICS: &'static str = "six springs along and about six skew axes instead of the frame's own";
    const SHOWS: Shows = Shows::Outside;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_N_PER_M: f64 = 3e8;
        let radius = hexapod.platform_radius();
        Self { compliance: full_compliance(USUAL_N_PER_M, radius, rng) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_plate(&Matrix6::from_fn(|i, j| self.compliance[i][j]));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { compliance: self.compliance.map(|row| row.map(|x| x * factor)) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("platform_compliance", json!(self.compliance))]
    }
}
