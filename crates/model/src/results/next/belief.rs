//! What an explanation expects of readings not yet taken.

use hexbench_core::{Dataset, LoadSequences, Observation};
use nalgebra::{DMatrix, DVector};

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, rows_of};
use crate::estimation::fit::{Fit, columns};
use crate::estimation::foreseen::inputs_after;
use crate::estimation::linearization::{Linearization, beside};
use crate::estimation::nuisance::ShownInputs;
use crate::estimation::tolerances::input_columns;

/// Gaussian expectation of every reading of a list: mean, and the columns by which uncertain parameters move it. Units of
/// the noise of one reading, six rows per reading.
#[derive(Debug, Clone)]
pub(super) struct Belief {
    pub(super) mean: DVector<f64>,
    pub(super) rows: DMatrix<f64>,
    pub(super) covariance: DMatrix<f64>,
}

impl Belief {
    /// Expectation of a fit to a campaign. Inputs that the campaign knows to a tolerance only are no better known in what follows it,
    /// but for what its readings tell of them.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub(super) fn of(plan: &Campaign, campaign: &Campaign, fit: &Fit) -> Result<Self, ModelError> {
        let lin = Linearization::at(plan, &fit.point)?;
        let (mean, rows) = (lin.predictions(), columns(&lin, &fit.point));
        let Some(inputs) = inputs_after(campaign, &fit.point)? else {
            return Ok(Self { mean, rows, covariance: fit.covariance.clone() });
        };
        let left = inputs.left(&input_columns(plan, &fit.point, &plan.hexapod.tolerances)?);
        let share = lin.whitened(inputs.share_of(&left));
        let left = lin.whitened(left);
        let left = &left * ShownInputs::of(&left).combinations;
        let parameters = rows.ncols();
        let mut covariance = DMatrix::identity(parameters + left.ncols(), parameters + left.ncols());
        covariance.view_mut((0, 0), (parameters, parameters)).copy_from(&fit.covariance);
        Ok(Self {
            mean: mean + share.column(parameters),
            rows: beside(&[rows - share.columns(0, parameters), left]),
            covariance,
        })
    }

    /// Mean and covariance of some readings, noise included; a reading that occurs twice is read twice.
    pub(super) fn moments(&self, readings: &[usize]) -> (DVector<f64>, DMatrix<f64>) {
        let picked = rows_of(readings.iter().copied());
        let rows = self.rows.select_rows(&picked);
        let noise = DMatrix::identity(picked.len(), picked.len());
        (self.mean.select_rows(&picked), noise + &rows * &self.covariance * rows.transpose())
    }
}

/// Readings as a campaign without measured values, each of them once and with the noise of one reading.
///
/// # Errors
/// [`ModelError::TooFewEquations`] for an empty list.
pub(super) fn as_plan(campaign: &Campaign, readings: &[Observation]) -> Result<Campaign, ModelError> {
    // What is read with sensors states its noise number by number.
    let sigma = |o: &Observation| o.sigma.filter(|_| !campaign.reads_poses);
    let once = readings.iter().map(|o| Observation { sigma: sigma(o), ..*o });
    let dataset = Dataset {
        source: String::new(),
        measurand: campaign.measurand,
        columns: campaign.columns,
        blocks: campaign.blocks.clone(),
        sequences: LoadSequences::default(),
        drawn_from: None,
        observations: once.collect(),
    };
    Campaign::in_frames(&campaign.hexapod, &dataset, campaign.noise, campaign.frames)
}
