//! The load acts away from the mobile origin: `load-offset`.
//!
//! The force of the wrench acts at `r'`, fixed to the platform, not at the mobile origin; its direction stays fixed in space.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::{Instant, Setup, setup::PointForce};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "load-offset",
    title: "The load acts away from the mobile origin",
    physics: "moment (R r') x F in both states",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LoadOffset>,
};

/// The load acts away from the mobile origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadOffset {
    /// Where the force acts `r'`, mobile frame, m.
    pub point: [f64; 3],
}

impl Mechanism for LoadOffset {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let force = setup.wrench.force;
        setup.wrench.force = Vector3::zeros();
        setup.forces.push(PointForce { point: self.point.into(), force });
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { point: self.point.map(|x| x * factor) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("cog".to_owned(), json!(self.point))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_M: f64 = 3e-3;
    Box::new(LoadOffset { point: normal3(rng, USUAL_M) })
}
