//! Zero lengths of the legs are off: `leg-offset`.
//!
//! The reference switch or the homing of each leg is off by a constant.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-offset",
    title: "Zero lengths of the legs are off",
    physics: "q = q(commanded) + offset_i",
    shows: Shows::Absolute,
    draw,
    parse: parsed::<LegOffset>,
};

/// Zero lengths of the legs are off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegOffset {
    /// True minus commanded length, m.
    pub offsets: [f64; 6],
}

impl Mechanism for LegOffset {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for (length, offset) in setup.leg_lengths.iter_mut().zip(self.offsets) {
            *length += offset;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { offsets: self.offsets.map(|x| x * factor) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("leg_offset".to_owned(), json!(self.offsets))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_M: f64 = 0.1e-3;
    let ([a, b, c], [d, e, f]) = (normal3(rng, USUAL_M), normal3(rng, USUAL_M));
    Box::new(LegOffset { offsets: [a, b, c, d, e, f] })
}
