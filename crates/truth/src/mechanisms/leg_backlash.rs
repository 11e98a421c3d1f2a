//! Play in the legs: `leg-backlash`.
//!
//! A loose nut or bearing: between pushing and pulling the leg crosses a gap in which it carries nothing.
//! A leg without force rests in the middle of its play: that is where the unloaded machine starts.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-backlash",
    title: "Play in the legs",
    physics: "e += (gap / 2) sgn(f)",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LegBacklash>,
};

/// Play in the legs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegBacklash {
    /// Whole width of the play, m.
    pub gap: f64,
}

impl Mechanism for LegBacklash {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.gap += self.gap;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { gap: self.gap * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("backlash".to_owned(), json!(self.gap))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegBacklash { gap: 1e-6 })
}
