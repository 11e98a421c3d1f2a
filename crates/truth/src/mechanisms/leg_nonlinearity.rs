//! Legs do not follow Hooke's law: `leg-nonlinearity`.
//!
//! Contacts in series with the leg spring: p = 2/3 for Hertzian balls, below 1 hardening, above 1 softening.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-nonlinearity",
    title: "Legs do not follow Hooke's law",
    physics: "e += kappa sgn(f) |f|^p",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LegNonlinearity>,
};

/// Legs do not follow Hooke's law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegNonlinearity {
    /// Size, m/N^p.
    pub kappa: f64,
    /// Exponent p.
    pub power: f64,
}

impl Mechanism for LegNonlinearity {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.powers.push((self.kappa, self.power));
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { kappa: self.kappa * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("power".to_owned(), json!([self.kappa, self.power]))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_ELONGATION_AT_100_N: f64 = 0.65e-6;
    let power = one_of(rng, &[2.0 / 3.0, 0.5, 2.0, 1.5]);
    Box::new(LegNonlinearity { kappa: USUAL_ELONGATION_AT_100_N / 100_f64.powf(power), power })
}
