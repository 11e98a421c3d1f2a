//! Comparison of a model with measurements: the error relative to the noise, where it occurs, what it follows, and what
//! the springs could absorb under this plan.
//!
//! Six legs measure six degrees of freedom, so every residual of a deflection maps one-to-one to six leg elongations;
//! this leg space shows the physics.

pub mod absorbed;
pub mod acts;
mod added;
pub mod adequacy;
pub mod association;
pub mod coordinates;
pub mod design;
mod follows;
pub mod legs;
pub mod periodogram;
pub mod rows;
pub mod story;
mod waves;

use hexbench_core::{Dataset, Hexapod};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::application::model_file::Model;
use crate::error::ModelError;
use crate::estimation::basis::orthonormal;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{columns, fit_baseline};
use crate::estimation::frames::Frames;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::estimation::noise::NoiseSource;
use crate::estimation::residuals::{ErrorSummary, Residual, prediction_errors, residuals, summarise};
use crate::inference::selection::same_kind;
use crate::results::diagnose::prepare;

use absorbed::{HiddenBias, hidden_biases};
use adequacy::{Adequacy, AdequacyAnswer, adequacy};
use association::{Association, associations};
use coordinates::{Coordinate, coordinates};
use design::{Design, design};
use legs::{LegResidual, LegSpace, leg_space};
use periodogram::{Peak, Spectra};
use rows::{Outlier, WorstPose, outliers, worst_poses};

/// Result of `compare`.
#[derive(Debug, Clone, Serialize)]
pub struct Comparison {
    /// `comparison/1`.
    pub format: &'static str,
    /// Terms of the model beside the springs.
    pub terms: Vec<String>,
    /// True when the springs were fitted to these very data; false when a saved model is compared as it is.
    pub fitted_here: bool,
    /// False when the fit ran out of iterations: its errors say nothing of the machine. In files only then.
    #[serde(skip_serializing_if = "is_true")]
    pub settled: bool,
    /// Readings compared.
    pub readings: usize,
    /// Distinct poses, loads and states among them.
    pub conditions: usize,
    /// Where the noise level comes from.
    pub noise_source: NoiseSource,
    /// Error over all readings.
    pub error: ErrorSummary,
    /// Error on held-out readings.
    pub holdout: Option<ErrorSummary>,
    /// Every measured coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Tests of the model as a whole.
    pub adequacy: Adequacy,
    /// Poses with the largest errors.
    pub worst_poses: Vec<WorstPose>,
    /// Readings far from the rest; none is dropped.
    pub outliers: Vec<Outlier>,
    /// Residual elongation of each leg; empty where the readings do not determine it under every condition.
    pub legs: Vec<LegResidual>,
    /// What the residual elongations follow, most significant first.
    pub associations: Vec<Association>,
    /// Strongest period of the residual elongations in leg length.
    pub period: Option<Peak>,
    /// What the plan lets be seen.
    pub design: Design,
    /// Bias of the leg stiffnesses by effects that could hide in these data.
    pub hidden: Vec<HiddenBias>,
    /// What the files were read as meaning otherwise than they say because somebody asked for it, as `KIND=VALUE`.
    pub read_as: Vec<String>,
}

/// A comparison with what it was made from, for charts.
#[derive(Debug, Clone)]
pub struct ComparedModel {
    /// What people read.
    pub comparison: Comparison,
    /// The readings.
    pub campaign: Campaign,
    /// The model compared.
    pub point: ModelPoint,
}

impl Comparison {
    /// What all readings say together: those held out are what a model is judged by.
    pub fn answer(&self) -> AdequacyAnswer {
        let is_foreseen = self.holdout.is_none_or(|held| held.is_at_the_noise());
        match self.adequacy.answer() {
            AdequacyAnswer::Adequate if !is_foreseen => AdequacyAnswer::NotHeldOut,
            answer => answer,
        }
    }
}

/// Compare springs fitted to the data, or a saved model, with the data.
///
/// # Errors
/// As [`fit_baseline`]; [`ModelError::Mismatch`] when model, data and holdout are of different kinds.
pub fn compare(
    hexapod: &Hexapod,
    data: &Dataset,
    model: Option<&Model>,
    holdout: Option<&Dataset>,
) -> Result<ComparedModel, ModelError> {
    refuse_mixture(data, model, holdout)?;
    let campaign = prepare(hexapod, data)?;
    let (point, settled) = if let Some(m) = model {
        campaign.refuse_astray(&Frames::of(&m.point.machine), &data.source)?;
        (m.point.clone(), m.settled)
    } else {
        let fit = fit_baseline(&campaign)?;
        let settled = fit.is_settled();
        (fit.point, settled)
    };
    let judged = JudgedModel::of(&campaign, data, &point, model.is_none())?;
    let held = |h: &Dataset| prediction_errors(hexapod, h, campaign.noise, &point);
    let holdout = holdout.map(held).transpose()?.map(|rows| summarise(&rows, None));
    let comparison = report(&judged, holdout, settled);
    Ok(ComparedModel { comparison, campaign, point })
}

fn refuse_mixture(
    data: &Dataset,
    model: Option<&Model>,
    holdout: Option<&Dataset>,
) -> Result<(), ModelError> {
    let other = model.is_some_and(|m| m.is_absolute() != data.is_absolute());
    if other {
        let why =
            format!("the model and {} are of different kinds (deflections, absolute poses)", data.source);
        return Err(ModelError::Mismatch(why));
    }
    holdout.map_or(Ok(()), |held| same_kind(data, held))
}

/// A model at a point, its residuals, and the columns it has in these data.
pub struct JudgedModel<'a> {
    pub(crate) campaign: &'a Campaign,
    pub(crate) data: &'a Dataset,
    pub(crate) point: &'a ModelPoint,
    /// The model linearized there.
    pub lin: Linearization,
    /// Residuals of single readings, in file order.
    pub rows: Vec<Residual>,
    /// Rank of what was fitted to these data; zero for a saved model.
    pub(crate) rank: f64,
    /// Orthonormal basis of the columns fitted to these data; empty for a saved model.
    pub(crate) basis: DMatrix<f64>,
    /// Whitened residuals of the averaged readings.
    pub(crate) white: DVector<f64>,
    /// Residuals of the averaged readings as elongations of the legs.
    pub space: LegSpace,
}

impl<'a> JudgedModel<'a> {
    /// A model beside the readings of a campaign; `fitted`: to these very readings.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn of(
        campaign: &'a Campaign,
        data: &'a Dataset,
        point: &'a ModelPoint,
        fitted: bool,
    ) -> Result<Self, ModelError> {
        Ok(Self::linearized(campaign, data, point, Linearization::at(campaign, point)?, fitted))
    }

    /// The same where the campaign has been linearized at the point already.
    pub(crate) fn linearized(
        campaign: &'a Campaign,
        data: &'a Dataset,
        point: &'a ModelPoint,
        lin: Linearization,
        fitted: bool,
    ) -> Self {
        let rows = residuals(campaign, &data.observations, |i| lin.residual(i));
        let columns = if fitted { columns(&lin, point) } else { DMatrix::zeros(lin.equations(), 0) };
        let basis = if fitted { orthonormal(columns) } else { columns };
        let (rank, white) = (basis.ncols() as f64, lin.residuals());
        let space = leg_space(campaign, &lin);
        Self { campaign, data, point, lin, rows, rank, basis, white, space }
    }
}

fn report(judged: &JudgedModel<'_>, holdout: Option<ErrorSummary>, settled: bool) -> Comparison {
    let dof = judged.campaign.numbers as f64 - judged.rank;
    let seen = judged.space.is_complete();
    Comparison {
        format: "comparison/1",
        terms: judged.point.active.iter().map(|a| a.id().to_owned()).collect(),
        fitted_here: judged.rank > 0.0,
        settled,
        readings: judged.rows.len(),
        conditions: judged.lin.conditions.len(),
        noise_source: judged.campaign.noise.source,
        error: summarise(&judged.rows, Some(dof)),
        holdout,
        coordinates: coordinates(judged.campaign, &judged.rows, &judged.data.observations, &judged.lin),
        adequacy: adequacy(judged),
        worst_poses: worst_poses(judged),
        outliers: outliers(judged),
        legs: if seen { legs::summaries(judged) } else { Vec::new() },
        associations: if seen { associations(judged) } else { Vec::new() },
        period: Spectra::of(judged).filter(|_| seen).and_then(|s| s.peak),
        design: design(judged),
        hidden: hidden_biases(judged),
        read_as: Vec::new(),
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_true(settled: &bool) -> bool {
    *settled
}
