//! Leg compliance grows under load: `creep`.
//!
//! Each leg spring keeps yielding after the load has changed from the reference force `f0`, by the share `chi` in the end.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "creep",
    title: "Leg compliance grows under load",
    physics: "e += chi c (f - f0) (1 - exp(-elapsed / tau))",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<Creep>,
};

/// Leg compliance grows under load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// Final growth of the compliance `chi`.
    pub share: f64,
    /// Time constant `tau`, s.
    pub time: f64,
}

impl Mechanism for Creep {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let grown = self.share * -(-moment.elapsed() / self.time).exp_m1();
        for (i, law) in setup.laws.iter_mut().enumerate() {
            let yielding = law.compliance * grown;
            law.compliance += yielding;
            law.offset -= yielding * moment.reference_forces[i];
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { share: self.share * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("creep".to_owned(), json!([self.share, self.time]))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(Creep { share: 0.05, time: one_of(rng, &[20.0, 60.0, 150.0]) })
}
