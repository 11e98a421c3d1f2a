//! From readings to leg stiffnesses, and from these to predictions.

use hexbench_core::statistics::root_mean_square;
use hexbench_core::{Dataset, Matrix6, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, fit_baseline};
use hexbench_model::estimation::foreseen::held_out_chance;
use hexbench_model::estimation::paper::{block, fit_paper};

use super::bench::{PaperMachine, sigma};

/// How stiffnesses are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PaperEstimator {
    /// The paper's: minimum-norm least squares without weights, meters and radians side by side.
    Paper,
    /// Generalised least squares: every number divided by its noise.
    Weighted,
}

/// Identified springs.
#[derive(Debug, Clone)]
pub struct Identified {
    /// Compliance of each leg, m/N.
    pub springs: Vector6,
    /// Covariance of the compliances under the noise of the readings, (m/N)^2.
    pub covariance: Matrix6,
    campaign: Campaign,
    fit: Fit,
}

impl Identified {
    /// Springs from readings.
    pub(crate) fn from(
        bench: &PaperMachine,
        data: &Dataset,
        estimator: PaperEstimator,
    ) -> Result<Self, ModelError> {
        let campaign = Campaign::new(&bench.hexapod, data)?;
        let fit = match estimator {
            PaperEstimator::Paper => fit_paper(&campaign, data)?.into_fit(&campaign)?,
            PaperEstimator::Weighted => fit_baseline(&campaign)?,
        };
        let covariance = Matrix6::from_fn(|i, j| fit.covariance[(i, j)]);
        Ok(Self { springs: fit.point.compliances, covariance, campaign, fit })
    }

    /// Stiffness of each leg and its standard uncertainty, N/um.
    pub fn stiffness(&self) -> [[f64; 2]; 6] {
        std::array::from_fn(|leg| {
            let compliance = self.springs[leg];
            let stiffness = 1e-6 / compliance;
            [stiffness, stiffness * self.covariance[(leg, leg)].sqrt() / compliance.abs()]
        })
    }

    /// Predicted deflection of each reading, m and rad.
    pub(crate) fn predict(&self, bench: &PaperMachine, data: &Dataset) -> Result<Vec<Vector6>, ModelError> {
        let one = |o| Ok(block(&bench.hexapod, o, data.measurand)? * self.springs);
        data.observations.iter().map(one).collect()
    }

    /// Error of prediction on other readings, root mean square by coordinate, um and urad.
    pub(crate) fn prediction_error(
        &self,
        bench: &PaperMachine,
        data: &Dataset,
    ) -> Result<[f64; 6], ModelError> {
        let predicted = self.predict(bench, data)?;
        let errors = data.observations.iter().zip(predicted).map(|(o, p)| Vector6::from(o.measured) - p);
        Ok(rms(errors))
    }

    /// What the error of prediction should be if springs are all there is: noise of the readings and of the springs.
    pub(crate) fn expected_error(
        &self,
        bench: &PaperMachine,
        data: &Dataset,
    ) -> Result<[f64; 6], ModelError> {
        let noise = Vector6::from(sigma()).map(|s| s * s);
        let mut total = Vector6::zeros();
        for reading in &data.observations {
            let a = block(&bench.hexapod, reading, data.measurand)?;
            total += noise + (a * self.covariance * a.transpose()).diagonal();
        }
        let n = data.observations.len().max(1) as f64;
        Ok((total / n).map(|v| v.sqrt() * 1e6).into())
    }

    /// Chance of errors as large as these if springs are all there is.
    pub(crate) fn chance(&self, data: &Dataset) -> Result<f64, ModelError> {
        held_out_chance(&self.campaign, data, &self.fit)
    }
}

/// Root mean square by coordinate, um and urad, of values in m and rad.
pub fn rms(values: impl IntoIterator<Item = Vector6>) -> [f64; 6] {
    let (mut sum, mut count) = (Vector6::zeros(), 0.0);
    for value in values {
        sum += value.component_mul(&value);
        count += 1.0;
    }
    (sum / f64::max(count, 1.0)).map(|v| v.sqrt() * 1e6).into()
}

/// Root mean square of three of six such numbers: the translations (0) or the rotations (1).
pub fn pooled(rms: &[f64; 6], part: usize) -> f64 {
    root_mean_square(rms[3 * part..3 * part + 3].iter().copied()).unwrap_or(0.0)
}
