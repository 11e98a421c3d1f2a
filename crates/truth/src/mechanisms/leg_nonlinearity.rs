//! Legs do not follow Hooke's law: `leg-nonlinearity`.
//!
//! Contacts in series with the leg spring: p = 2/3 for Hertzian balls, below 1 hardening, above 1 softening.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Setup};

/// Legs do not follow Hooke's law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegNonlinearity {
    /// Size, m/N^p.
    pub kappa: f64,
    /// Exponent p.
    pub power: f64,
}

impl Registered for LegNonlinearity {
    const ID: &'static str = "leg-nonlinearity";
    const TITLE: &'static str = "Legs do not follow Hooke's law";
    const PHYSICS: &'static str = "e += kappa sgn(f) |f|^p";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_ELONGATION_AT_100_N: f64 = 0.65e-6;
        let power = one_of(rng, &[2.0 / 3.0, 0.5, 2.0, 1.5]);
        Self { kappa: USUAL_ELONGATION_AT_100_N / 100_f64.powf(power), power }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.powers.push((self.kappa, self.power));
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { kappa: self.kappa * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("power", json!([self.kappa, self.power]))]
    }
}
