//! Leg compliance grows with free length: `leg-length-compliance`.
//!
//! The free part of a lead screw is a bar in series with the rest of the leg: its compliance is proportional to its
//! length. `q` is the present length, `q_home` that of the zero pose.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup, law::LengthCompliance};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-length-compliance",
    title: "Leg compliance grows with free length",
    physics: "c_i = c + s (q - q_home)",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LegLengthCompliance>,
};

/// Leg compliance grows with free length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegLengthCompliance {
    /// Compliance per length `s`, 1/N.
    pub slope: f64,
}

impl Mechanism for LegLengthCompliance {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for (i, law) in setup.laws.iter_mut().enumerate() {
            law.along_length
                .push(LengthCompliance::Growing { slope: self.slope, home: moment.home_lengths[i] });
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { slope: self.slope * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("screw".to_owned(), json!(self.slope))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegLengthCompliance { slope: 4e-7 })
}
