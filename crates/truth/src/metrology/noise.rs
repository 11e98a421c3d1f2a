//! Noise of one reading.

use hexbench_core::{Metrology, Vector6};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Independent Gaussian noise on the six numbers of a reading, with an occasional blunder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InstrumentNoise {
    /// Of each translation, m.
    pub sigma_translation: f64,
    /// Of each rotation, rad.
    pub sigma_rotation: f64,
    /// Share of readings of which one number is wrong.
    pub blunder_rate: f64,
    /// Size of a blunder in standard deviations.
    pub blunder_sigmas: f64,
}

impl Default for InstrumentNoise {
    /// 0.5 um and 3 urad, no blunders.
    fn default() -> Self {
        Self { sigma_translation: 0.5e-6, sigma_rotation: 3e-6, blunder_rate: 0.0, blunder_sigmas: 15.0 }
    }
}

impl InstrumentNoise {
    /// Standard deviations of the six numbers, m and rad.
    pub fn sigma(&self) -> Vector6 {
        let (t, r) = (self.sigma_translation, self.sigma_rotation);
        Vector6::new(t, t, t, r, r, r)
    }

    /// What a file states of one reading, if it does; usual else.
    pub fn stated_or_usual(stated: Option<Metrology>) -> Self {
        let usual = Self::default();
        stated.map_or(usual, |Metrology { sigma_translation, sigma_rotation }| Self {
            sigma_translation,
            sigma_rotation,
            ..usual
        })
    }

    /// What the hexapod's file states about it.
    pub fn metrology(&self) -> Metrology {
        Metrology { sigma_translation: self.sigma_translation, sigma_rotation: self.sigma_rotation }
    }

    /// The error of one reading. Draws the same count of numbers whatever the settings but for blunders.
    pub fn draw(&self, rng: &mut Pcg64) -> Vector6 {
        let unit = Vector6::from_fn(|_, _| StandardNormal.sample(rng));
        let mut error = unit.component_mul(&self.sigma());
        if self.blunder_rate > 0.0 && rng.random_bool(self.blunder_rate.min(1.0)) {
            let k = rng.random_range(0..6);
            let side = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
            error[k] += side * self.blunder_sigmas * self.sigma()[k];
        }
        error
    }
}
