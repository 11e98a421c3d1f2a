//! The two methods.

use crate::application::model_file::{DataOrigin, Estimator, Model};
use crate::application::predict::{Prediction, predict};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::estimate::{Estimate, estimates};
use crate::estimation::fit::Fit;
use crate::estimation::paper::fit_paper;
use crate::inference::verdict::Verdict;
use crate::results::diagnose::{Diagnosis, diagnose, prepare};
use crate::terms::catalogue;

use super::{AnswerError, CaseFiles};

/// What a method says about a case.
pub(crate) struct Answer {
    pub(crate) parameters: Vec<Estimate>,
    pub(crate) predictions: Vec<Prediction>,
    pub(crate) diagnosis: Option<Diagnosis>,
}

/// The whole diagnosis; predictions are those of its last model. Where something outside the catalogue is at work, their uncertainty
/// holds what the model misses.
pub(crate) fn hexbench(case: &CaseFiles) -> Result<Answer, AnswerError> {
    let study = diagnose(&case.hexapod, &case.measurements, None, &catalogue())?;
    let last = study.fits.last().unwrap_or(&study.outcome.baseline);
    let mut predictions = predictions(case, &study.campaign, last, Estimator::Gls)?;
    let diagnosis = study.diagnosis;
    if diagnosis.verdict == Verdict::Outside {
        let missed = missed(&diagnosis, &study.campaign.noise.sigma());
        for prediction in &mut predictions {
            widen(prediction, &missed);
        }
    }
    Ok(Answer { parameters: diagnosis.parameters.clone(), predictions, diagnosis: Some(diagnosis) })
}

/// What a model that is known to lack something misses of readings left out of its fit, beyond their noise; m and rad. It will miss as
/// much of the readings to come: `sigma sqrt(chi2 - 1)`.
fn missed(diagnosis: &Diagnosis, noise: &[f64; 6]) -> [f64; 6] {
    let left_out = diagnosis.steps.last().and_then(|step| step.holdout);
    let excess = left_out.map_or(0.0, |error| error.beyond_noise());
    noise.map(|sigma| sigma * excess)
}

fn widen(prediction: &mut Prediction, missed: &[f64; 6]) {
    for (sigma, more) in prediction.sigma.iter_mut().zip(missed) {
        *sigma = sigma.hypot(*more);
    }
}

/// The paper's estimator; it knows springs only and says nothing about effects.
pub(crate) fn paper(case: &CaseFiles) -> Result<Answer, AnswerError> {
    let campaign = prepare(&case.hexapod, &case.measurements)?;
    let fit = fit_paper(&campaign, &case.measurements)?.into_fit(&campaign)?;
    let predictions = predictions(case, &campaign, &fit, Estimator::Paper)?;
    Ok(Answer { parameters: estimates(&fit).determined, predictions, diagnosis: None })
}

fn predictions(
    case: &CaseFiles,
    campaign: &Campaign,
    fit: &Fit,
    estimator: Estimator,
) -> Result<Vec<Prediction>, AnswerError> {
    if !fit.covariance.iter().all(|x| x.is_finite()) {
        return Err(ModelError::NotFinite { what: "the covariance of the fit" }.into());
    }
    let fitted = Model::new(campaign, fit, estimator, DataOrigin::default());
    let model = Model { measurand: case.predicted(), ..fitted };
    Ok(predict(&model, &case.asked.observations)?)
}

#[cfg(test)]
mod tests;
