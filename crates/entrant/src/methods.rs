//! The two methods.

use hexbench_model::campaign::Campaign;
use hexbench_model::diagnose::{Diagnosis, diagnose, prepare};
use hexbench_model::error::ModelError;
use hexbench_model::estimate::{Estimate, estimates};
use hexbench_model::fit::Fit;
use hexbench_model::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::paper::fit_paper;
use hexbench_model::predict::{Prediction, predict};
use hexbench_model::terms::catalogue;

use crate::{Case, EntrantError};

/// What a method says about a case.
pub(crate) struct Answer {
    pub(crate) parameters: Vec<Estimate>,
    pub(crate) predictions: Vec<Prediction>,
    pub(crate) diagnosis: Option<Diagnosis>,
}

/// The whole diagnosis; predictions are those of its last model.
pub(crate) fn hexbench(case: &Case) -> Result<Answer, EntrantError> {
    let study = diagnose(&case.hexapod, &case.measurements, None, &catalogue())?;
    let last = study.fits.last().unwrap_or(&study.outcome.baseline);
    let predictions = predictions(case, &study.campaign, last, Estimator::Gls)?;
    let diagnosis = study.diagnosis;
    Ok(Answer { parameters: diagnosis.parameters.clone(), predictions, diagnosis: Some(diagnosis) })
}

/// The paper's estimator; it knows springs only and says nothing about effects.
pub(crate) fn paper(case: &Case) -> Result<Answer, EntrantError> {
    let campaign = prepare(&case.hexapod, &case.measurements)?;
    let fit = fit_paper(&campaign, &case.measurements)?.into_fit(&campaign)?;
    let predictions = predictions(case, &campaign, &fit, Estimator::Paper)?;
    Ok(Answer { parameters: estimates(&fit).determined, predictions, diagnosis: None })
}

fn predictions(
    case: &Case,
    campaign: &Campaign,
    fit: &Fit,
    estimator: Estimator,
) -> Result<Vec<Prediction>, EntrantError> {
    if !fit.covariance.iter().all(|x| x.is_finite()) {
        return Err(ModelError::NotFinite { what: "the covariance of the fit" }.into());
    }
    let model = Model::new(campaign, fit, estimator, DataOrigin::default());
    Ok(predict(&model, &case.asked.observations)?)
}
