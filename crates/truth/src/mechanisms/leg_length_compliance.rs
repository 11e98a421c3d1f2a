//! Leg compliance grows with free length: `leg-length-compliance`.
//!
//! The free part of a lead screw is a bar in series with the rest of the leg: its compliance is proportional to its
//! length. `q` is the present length, `q_home` that of the zero pose.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup, law::LengthCompliance};

/// Leg compliance grows with free length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegLengthCompliance {
    /// Compliance per length `s`, 1/N.
    pub slope: f64,
}

impl Registered for LegLengthCompliance {
    const ID: &'static str = "leg-length-compliance";
    const TITLE: &'static str = "Leg compliance grows with free length";
    const PHYSICS: &'static str = "c_i = c + s (q - q_home)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { slope: 4e-7 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, law) in setup.laws.iter_mut().enumerate() {
            law.along_length
                .push(LengthCompliance::Growing { slope: self.slope, home: moment.home_lengths[i] });
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { slope: self.slope * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("screw", json!(self.slope))]
    }
}
