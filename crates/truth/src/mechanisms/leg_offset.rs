//! Zero lengths of the legs are off: `leg-offset`.
//!
//! The reference switch or the homing of each leg is off by a constant.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal6};
use crate::{Instant, Setup};

/// Zero lengths of the legs are off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegOffset {
    /// True minus commanded length, m.
    pub offsets: [f64; 6],
}

impl Registered for LegOffset {
    const ID: &'static str = "leg-offset";
    const TITLE: &'static str = "Zero lengths of the legs are off";
    const PHYSICS: &'static str = "q = q(commanded) + offset_i";
    const SHOWS: Shows = Shows::Absolute;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_M: f64 = 0.1e-3;
        Self { offsets: normal6(rng, [USUAL_M; 2]) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for (length, offset) in setup.leg_lengths.iter_mut().zip(self.offsets) {
            *length += offset;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { offsets: self.offsets.map(|x| x * factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("leg_offset", json!(self.offsets))]
    }
}
