//! Readings of every row, those of wrong rows too; what was found of the noise and of the inputs still holds.

use hexbench_core::{Dataset, Hexapod, Observation, Tolerances};

use super::Examined;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::fit;
use crate::estimation::noise::Noise;
use crate::estimation::tolerances::{InputKind, input_columns, within_tolerances};

impl Examined {
    /// The examined readings with the rows of `data` that were left out put back, and their campaign. `noise`: before the
    /// examination.
    ///
    /// # Errors
    /// As [`Campaign::with_noise`] and [`fit`].
    pub fn with_all_rows(
        &self,
        hexapod: &Hexapod,
        data: &Dataset,
        noise: Noise,
    ) -> Result<(Dataset, Campaign), ModelError> {
        let mut all = data.clone();
        let scale = self.noise.translation / noise.translation;
        let mut examined = self.data.observations.iter().peekable();
        for row in &mut all.observations {
            row.sigma = match examined.next_if(|o| Observation { sigma: row.sigma, ..**o } == *row) {
                Some(known) => known.sigma,
                None => row.sigma.map(|sigma| sigma.map(|s| s * scale)),
            };
        }
        let campaign = Campaign::with_noise(hexapod, &all, self.noise)?;
        let campaign = match self.widened {
            None => within_tolerances(campaign),
            Some(input) => {
                let springs = fit(&campaign, &[], None)?;
                let tolerances = widened(hexapod.tolerances, input);
                let columns = input_columns(&campaign, &springs.point, &tolerances)?;
                campaign.with_inexact(columns)
            }
        };
        Ok((all, campaign))
    }
}

/// Tolerances of which one is as large as it seems.
fn widened(stated: Tolerances, (kind, size): (InputKind, f64)) -> Tolerances {
    match kind {
        InputKind::Joints => Tolerances { joints: size, ..stated },
        InputKind::LoadGain => Tolerances { load_gain: size, ..stated },
        InputKind::LoadDirection => Tolerances { load_direction: size, ..stated },
        InputKind::LoadPoint => Tolerances { load_point: size, ..stated },
        InputKind::Frame => Tolerances { frame: size, ..stated },
    }
}
