//! Play in the legs: `leg-backlash`.
//!
//! A loose nut or bearing: between pushing and pulling the leg crosses a gap in which it carries nothing.
//! A leg without force rests in the middle of its play: that is where the unloaded machine starts.
//!
//! Flanks do not meet all at once: rough, bent or lubricated ones close over some newtons, the width of the contact.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed_if};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-backlash",
    title: "Play in the legs",
    physics: "e += (gap / 2) sgn(f); of a contact with a width w: (gap / 2) tanh(f / w)",
    shows: Shows::Deflection,
    draw,
    parse: |value| parsed_if::<LegBacklash>(value, |play| play.width >= 0.0, "the width is not negative"),
};

/// Play in the legs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegBacklash {
    /// Whole width of the play, m.
    pub gap: f64,
    /// Force over which the contact closes, N; zero: at once.
    #[serde(default)]
    pub width: f64,
}

impl Mechanism for LegBacklash {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            if self.width > 0.0 {
                law.soft_gaps.push((self.gap, self.width));
            } else {
                law.gap += self.gap;
            }
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { gap: self.gap * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        let mut all = Map::from_iter([("backlash".to_owned(), json!(self.gap))]);
        if self.width > 0.0 {
            all.insert("backlash_width".to_owned(), json!(self.width));
        }
        all
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegBacklash { gap: 1e-6, width: 0.0 })
}
