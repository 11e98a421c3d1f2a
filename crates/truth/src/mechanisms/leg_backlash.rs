//! Play in the legs: `leg-backlash`.
//!
//! A loose nut or bearing: between pushing and pulling the leg crosses a gap in which it carries nothing.
//! A leg without force rests in the middle of its play: that is where the unloaded machine starts.
//!
//! Flanks do not meet all at once: rough, bent or lubricated ones close over some newtons, the width of the contact.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

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

impl Registered for LegBacklash {
    const ID: &'static str = "leg-backlash";
    const TITLE: &'static str = "Play in the legs";
    const PHYSICS: &'static str = "e += (gap / 2) sgn(f); of a contact with a width w: (gap / 2) tanh(f / w)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { gap: 1e-6, width: 0.0 }
    }

    fn check(&self) -> Result<(), &'static str> {
        if self.width >= 0.0 { Ok(()) } else { Err("the width is not negative") }
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

    fn scaled(&self, factor: f64) -> Self {
        Self { gap: self.gap * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        let mut all = vec![("backlash", json!(self.gap))];
        if self.width > 0.0 {
            all.push(("backlash_width", json!(self.width)));
        }
        all
    }
}
