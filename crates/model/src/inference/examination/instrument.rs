//! What was found of the instrument: it holds for its other readings too.

use hexbench_core::{Dataset, Vector6};

use super::{DeadBand, of_rows};
use crate::estimation::noise::Noise;
use crate::estimation::residuals::Residual;

/// An instrument that may not be as the file states.
#[derive(Debug, Clone)]
pub(crate) struct Instrument {
    /// What it does not show, which is taken out of the readings.
    pub(crate) dead_band: Option<DeadBand>,
    /// Standard deviations on the whole, over those that rows or sensors state.
    pub(crate) scales: Vector6,
    /// Degrees of freedom of Student's t that its errors have; none where they are Gaussian.
    pub(crate) tails: Option<f64>,
}

impl Instrument {
    /// One that is as stated.
    pub(crate) fn as_stated() -> Self {
        Self { dead_band: None, scales: Vector6::repeat(1.0), tails: None }
    }

    /// True for one that sticks alike, or, as this one, not at all.
    pub(crate) fn sticks_like(&self, other: &Self) -> bool {
        match (&self.dead_band, &other.dead_band) {
            (Some(own), Some(other)) => own.resembles(other),
            (own, other) => own.is_none() && other.is_none(),
        }
    }

    /// Other readings of it, freed of what it does not show and as uncertain as it was found to be.
    pub(crate) fn read_alike(&self, others: &Dataset, noise: &Noise) -> Dataset {
        let mut all = others.clone();
        rescale(&mut all, &self.scales);
        match &self.dead_band {
            Some(band) => band.without(&all, noise),
            None => all,
        }
    }

    /// Readings [`Self::read_alike`], by what a model leaves of them, each weighed as its tails ask for: chi-square is then what a
    /// Gaussian gives, and a model that misses all of them still misses them.
    pub(crate) fn weighed(&self, mut alike: Dataset, noise: &Noise, left: &[Residual]) -> Dataset {
        let Some(freedom) = self.tails else { return alike };
        let whole = whole_of_tails(freedom);
        let mut left = left.iter();
        of_rows(&mut alike, noise, |_, sigma| {
            let z = left.next().map_or_else(Vector6::zeros, |left| left.whitened * whole);
            Vector6::from_fn(|k, _| sigma[k] / whole * weight_in_tails(freedom, z[k]))
        });
        alike
    }
}

/// Standard deviation of Student's t over its level.
pub(super) fn whole_of_tails(freedom: f64) -> f64 {
    (freedom / (freedom - 2.0)).sqrt()
}

/// Standard deviation over the level that the maximum likelihood of Student's t gives a number that is so far off: chi-square is then what
/// a Gaussian gives.
pub(super) fn weight_in_tails(freedom: f64, z: f64) -> f64 {
    ((freedom + z * z) / (freedom + 1.0)).sqrt()
}

/// Multiplies the standard deviations that rows state themselves.
pub(super) fn rescale(data: &mut Dataset, scales: &Vector6) {
    for row in &mut data.observations {
        row.sigma = row.sigma.map(|sigma| scaled(&sigma, scales));
    }
}

/// Standard deviations, each times its scale.
pub(super) fn scaled(sigma: &[f64; 6], scales: &Vector6) -> [f64; 6] {
    std::array::from_fn(|k| sigma[k] * scales[k])
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Observation, Pose, Wrench};

    use super::*;

    #[test]
    fn other_readings_are_as_uncertain_as_the_examined_ones_where_they_state_it_themselves() {
        let silent = Observation::unread(Pose::default(), Wrench::default(), Wrench::default());
        let stating = Observation { sigma: Some([1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6]), ..silent };
        let others = Dataset::of_deflections("others", vec![silent, stating]);
        let scales = Vector6::new(2.0, 1.0, 1.0, 1.0, 1.0, 0.5);
        let found = Instrument { scales, ..Instrument::as_stated() };
        let read = found.read_alike(&others, &Noise::stated(1e-6, 6e-6));
        assert_eq!(read.observations[0].sigma, None);
        assert_eq!(read.observations[1].sigma, Some([2e-6, 2e-6, 3e-6, 4e-6, 5e-6, 3e-6]));
        let as_stated = Instrument::as_stated().read_alike(&others, &Noise::stated(1e-6, 6e-6));
        assert_eq!(as_stated.observations, others.observations);
    }
}
