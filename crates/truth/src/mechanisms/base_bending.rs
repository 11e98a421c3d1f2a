//! The foundation bends as a full 6x6 compliance: `out:base-bending`.
//!
//! A real structure couples translation with rotation: its compliance is a full symmetric positive matrix at the center of the base-joint plane, fixed axes.
//! The same physics as `base-compliance`, in the form that six diagonal springs cannot take.

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, full_compliance, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:base-bending",
    title: "The foundation bends as a full 6x6 compliance",
    physics: "six springs along and about six skew axes instead of the frame's own",
    shows: Shows::Outside,
    draw,
    parse: parsed::<BaseBending>,
};

/// The foundation bends as a full 6x6 compliance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaseBending {
    /// Symmetric, at the center of the base-joint plane, fixed axes; m/N, rad/N, rad/(N m).
    pub compliance: [[f64; 6]; 6],
}

impl Mechanism for BaseBending {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_base(&Matrix6::from_fn(|i, j| self.compliance[i][j]));
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { compliance: self.compliance.map(|row| row.map(|x| x * factor)) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("base_compliance".to_owned(), json!(self.compliance))])
    }
}

fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_N_PER_M: f64 = 2e8;
    let radius = hexapod.base_joints.iter().map(|a| a.xy().norm()).sum::<f64>() / 6.0;
    Box::new(BaseBending { compliance: full_compliance(USUAL_N_PER_M, radius, rng) })
}
