//! The measured point is not the mobile origin: `target-offset`.
//!
//! The origin of the measured targets sits at `r'` on the platform.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::{Instant, equilibrium::Body};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "target-offset",
    title: "The measured point is not the mobile origin",
    physics: "reading of t + R r'",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<TargetOffset>,
};

/// The measured point is not the mobile origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetOffset {
    /// Measured point, mobile frame, m.
    pub point: [f64; 3],
}

impl Mechanism for TargetOffset {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn see(&self, _: &Instant<'_>, body: &mut Body) {
        body.origin += body.axes * Vector3::from(self.point);
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { point: self.point.map(|x| x * factor) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("target".to_owned(), json!(self.point))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_M: f64 = 5e-3;
    Box::new(TargetOffset { point: normal3(rng, USUAL_M) })
}
