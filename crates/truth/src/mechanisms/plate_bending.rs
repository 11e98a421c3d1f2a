//! The plate bends as a full 6x6 compliance: `out:plate-bending`.
//!
//! A real structure couples translation with rotation: its compliance is a full symmetric positive matrix at the mobile origin, mobile axes.
//! The same physics as `platform-compliance`, in the form that six diagonal springs cannot take.

use hexbench_core::{Hexapod, Matrix6};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, full_compliance, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:plate-bending",
    title: "The plate bends as a full 6x6 compliance",
    physics: "six springs along and about six skew axes instead of the frame's own",
    shows: Shows::Outside,
    draw,
    parse: parsed::<PlateBending>,
};

/// The plate bends as a full 6x6 compliance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlateBending {
    /// Symmetric, at the mobile origin, mobile axes; m/N, rad/N, rad/(N m).
    pub compliance: [[f64; 6]; 6],
}

impl Mechanism for PlateBending {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.yield_plate(&Matrix6::from_fn(|i, j| self.compliance[i][j]));
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { compliance: self.compliance.map(|row| row.map(|x| x * factor)) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("platform_compliance".to_owned(), json!(self.compliance))])
    }
}

fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_N_PER_M: f64 = 3e8;
    let radius = hexapod.platform_radius();
    Box::new(PlateBending { compliance: full_compliance(USUAL_N_PER_M, radius, rng) })
}
