//! What was found of the instrument: it holds for its other readings too.

use hexbench_core::{Dataset, Vector6};

use super::DeadBand;
use crate::estimation::noise::Noise;

/// An instrument that may not be as the file states.
#[derive(Debug, Clone)]
pub(crate) struct Instrument {
    /// What it does not show, which is taken out of the readings.
    pub(crate) dead_band: Option<DeadBand>,
    /// Standard deviations on the whole, over those that rows or sensors state.
    pub(crate) scales: Vector6,
}

impl Instrument {
    /// One that is as stated.
    pub(crate) fn as_stated() -> Self {
        Self { dead_band: None, scales: Vector6::repeat(1.0) }
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
