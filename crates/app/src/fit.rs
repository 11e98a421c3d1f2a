//! Fitting the terms that somebody names.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Vector6};
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::effects::term::Term;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit_named::{Added, refuse_undetermined};
use hexbench_model::estimation::paper::fit_paper;
use hexbench_model::inference::selection::{FitWithErrors, JudgedTask};
use hexbench_model::results::diagnose::{Diagnosis, DiagnosisStudy, prepare_to_fit};

use crate::Failure;
use crate::input::catalogue_with;

/// Readings, and what is fitted to them beside the springs.
pub struct ToFit<'a> {
    /// The readings that count.
    pub data: Cow<'a, Dataset>,
    /// Lines left out.
    pub exclude: Vec<u64>,
    /// Their campaign.
    pub campaign: Campaign,
    /// Terms beside the springs.
    pub added: Vec<Added>,
}

impl<'a> ToFit<'a> {
    /// All readings, with terms that somebody named.
    ///
    /// # Errors
    /// [`Failure::Model`].
    pub fn named(hexapod: &Hexapod, data: &'a Dataset, added: Vec<Added>) -> Result<Self, Failure> {
        let failed = Failure::of_model(&data.source);
        let campaign = prepare_to_fit(hexapod, data, &added).map_err(failed)?;
        Ok(Self { data: Cow::Borrowed(data), exclude: Vec::new(), campaign, added })
    }
}

/// What is fitted beside the springs: terms by name, and the user's own, whether named or not.
///
/// # Errors
/// [`Failure::Usage`] for the paper's estimator with terms, [`Failure::Model`] for a name that is none.
pub fn added(names: &[String], own: Vec<Arc<dyn Term>>, estimator: Estimator) -> Result<Vec<Added>, Failure> {
    if estimator == Estimator::Paper && !(names.is_empty() && own.is_empty()) {
        return Err(Failure::usage(
            "the paper's estimator knows leg springs only",
            "Omit --estimator paper to add effects.",
        ));
    }
    let all = catalogue_with(&own);
    let named = names.iter().map(|name| Added::named(name, &all).map_err(Failure::of_name));
    let mut added = named.collect::<Result<Vec<_>, _>>()?;
    let asked = |t: &Arc<dyn Term>| added.iter().any(|a| a.term.info().id == t.info().id);
    let fresh: Vec<_> = own.into_iter().filter(|t| !asked(t)).collect();
    added.extend(fresh.into_iter().map(Added::from));
    Ok(added)
}

/// A fit whose every number the data determine, judged.
///
/// # Errors
/// [`Failure::Model`].
pub fn fitted(
    task: &JudgedTask<'_>,
    added: &[Added],
    estimator: Estimator,
) -> Result<FitWithErrors, Failure> {
    let failed = Failure::of_model(&task.data.source);
    let judged = judged(task, added, estimator).map_err(failed)?;
    refuse_undetermined(&judged.fit).map_err(failed)?;
    Ok(judged)
}

/// The model of a fit, to be kept; `sha256` is that of the file of the data.
pub fn model(task: &JudgedTask<'_>, judged: &FitWithErrors, estimator: Estimator, sha256: String) -> Model {
    let origin = DataOrigin {
        file: task.data.source.clone(),
        sha256,
        readings: task.data.observations.len(),
        read_as: Vec::new(),
        excluded: Vec::new(),
    };
    Model::new(task.campaign, &judged.fit, estimator, origin).open_by(&judged.left.share)
}

/// The fitted model of a diagnosis, to be kept: of the readings that it judged sound, with their noise. `data`: all readings; `sha256` is that
/// of their file.
///
/// # Errors
/// [`Failure::Usage`] where the diagnosis draws no conclusion about the machine.
pub fn diagnosed_model(study: &DiagnosisStudy, data: &Dataset, sha256: String) -> Result<Model, Failure> {
    let fitted = study.fits.last().filter(|_| !study.diagnosis.parameters.is_empty());
    let fit = fitted.ok_or_else(|| {
        Failure::usage(
            "there is no model to save: the diagnosis draws no conclusion about the machine",
            "Correct the files as the page says, then run it again.",
        )
    })?;
    let used: BTreeSet<u64> = study.data.observations.iter().map(|row| row.line).collect();
    let all: BTreeSet<u64> = data.observations.iter().map(|row| row.line).collect();
    let origin = DataOrigin {
        file: data.source.clone(),
        sha256,
        readings: study.data.observations.len(),
        read_as: study.diagnosis.read_as.clone(),
        excluded: all.difference(&used).copied().collect(),
    };
    Ok(as_uncertain_as(&study.diagnosis, Model::new(&study.campaign, fit, Estimator::Gls, origin)))
}

/// A model whose springs are as uncertain as a diagnosis says: it counts what is left of the legs, and the explanations that remain beside
/// that of the model.
fn as_uncertain_as(diagnosis: &Diagnosis, model: Model) -> Model {
    let beyond = Vector6::from_fn(|leg, _| {
        let own = model.std(leg) / model.point.compliances[leg];
        let whole = diagnosis.stiffness(leg).map_or(0.0, |k| k.std / k.value);
        (whole.powi(2) - own.powi(2)).max(0.0).sqrt()
    });
    model.open_by(&beyond)
}

fn judged(task: &JudgedTask<'_>, added: &[Added], estimator: Estimator) -> Result<FitWithErrors, ModelError> {
    match estimator {
        Estimator::Gls => task.fit(added),
        Estimator::Paper => task.judge(fit_paper(task.campaign, task.data)?.into_fit(task.campaign)?, None),
    }
}
