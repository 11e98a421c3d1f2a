//! Readings of every row, those of wrong rows too; what was found of the noise and of the inputs still holds.

use hexbench_core::{Dataset, Hexapod, Observation};

use super::Examined;
use super::instrument::scaled;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::noise::Noise;

impl Examined {
    /// The examined readings with the rows of `data` that were left out put back, and their campaign. `noise`: before the
    /// examination.
    ///
    /// # Errors
    /// As [`Campaign::with_noise`].
    pub fn with_all_rows(
        &self,
        hexapod: &Hexapod,
        data: &Dataset,
        noise: Noise,
    ) -> Result<(Dataset, Campaign), ModelError> {
        let mut all = self
            .instrument
            .dead_band
            .as_ref()
            .map_or_else(|| data.clone(), |band| band.without(data, &noise));
        let mut examined = self.data.observations.iter().peekable();
        for row in &mut all.observations {
            row.sigma = match examined.next_if(|o| Observation { sigma: row.sigma, ..**o } == *row) {
                Some(known) => known.sigma,
                None => row.sigma.map(|sigma| scaled(&sigma, &self.instrument.scales)),
            };
        }
        let campaign = self.campaign_of(hexapod, &all)?;
        Ok((all, campaign))
    }
}
