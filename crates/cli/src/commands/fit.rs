//! `hexbench fit HEXAPOD DATA --add TERM -o model.toml`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use hexbench_core::Dataset;
use hexbench_core::files::content_hash;
use hexbench_model::diagnose::prepare;
use hexbench_model::error::ModelError;
use hexbench_model::fit_named::{Added, refuse_undetermined};
use hexbench_model::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::paper::fit_paper;
use hexbench_model::selection::{Judged, Task};
use hexbench_model::term::Term;
use hexbench_pages::fitted;

use crate::failure::Failure;
use crate::input;
use crate::output::Screen;

/// Fit leg stiffnesses and the effects you name, and save the model
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Deflections or absolute poses: measurements.csv
    data: PathBuf,
    /// Add this effect beside the leg springs, with `:richer` behind it in its richer form; may be given several times
    #[arg(long, value_name = "TERM")]
    add: Vec<String>,
    /// Readings kept out of the fit, to judge it
    #[arg(long, value_name = "FILE")]
    holdout: Option<PathBuf>,
    /// How the numbers are found
    #[arg(long, value_enum, default_value_t = Method::Gls)]
    estimator: Method,
    /// A term file of your own (term/1); it is added to the model. May be given several times
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// Write the model to FILE (model.toml)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Estimators by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Generalised least squares, weighted by the noise
    Gls,
    /// The paper's unweighted minimum-norm least squares; springs and deflections only
    Paper,
}

/// Fit, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let data = input::measurements(&arguments.data)?;
    let holdout = arguments.holdout.as_deref().map(input::measurements).transpose()?;
    let added = added(arguments)?;
    let failed = |cause: ModelError| Failure::Model { cause, data: data.source.clone() };
    let campaign = prepare(&hexapod, &data).map_err(failed)?;
    let task = Task { hexapod: &hexapod, data: &data, campaign: &campaign, holdout: holdout.as_ref() };
    let judged = fit(arguments, &task, &added).map_err(failed)?;
    refuse_undetermined(&judged.fit).map_err(failed)?;
    let estimator = if arguments.estimator == Method::Paper { Estimator::Paper } else { Estimator::Gls };
    screen.write(&fitted::report(&task, &judged, estimator, screen.ink()))?;
    let Some(path) = &arguments.output else { return Ok(()) };
    let model = Model::new(&campaign, &judged.fit, estimator, origin(&arguments.data, &data)?);
    let unsaved = |cause| Failure::ModelFile { path: path.clone(), cause: Box::new(cause) };
    let text = model.to_toml().map_err(unsaved)?;
    screen.write_to(path, &text)
}

fn added(arguments: &Arguments) -> Result<Vec<Added>, Failure> {
    if arguments.estimator == Method::Paper && !(arguments.add.is_empty() && arguments.terms.is_empty()) {
        return Err(Failure::Usage {
            message: "the paper's estimator knows leg springs only".into(),
            next: "Leave out --estimator paper to add effects.".into(),
        });
    }
    let own = input::user_terms(&arguments.terms)?;
    let all = input::catalogue_with(&own);
    let failed = |cause| Failure::Model { cause, data: String::new() };
    let named = arguments.add.iter().map(|name| Added::named(name, &all).map_err(failed));
    let mut added = named.collect::<Result<Vec<_>, _>>()?;
    let asked = |t: &Arc<dyn Term>| added.iter().any(|a| a.term.info().id == t.info().id);
    let fresh: Vec<_> = own.into_iter().filter(|t| !asked(t)).collect();
    added.extend(fresh.into_iter().map(Added::from));
    Ok(added)
}

fn fit(arguments: &Arguments, task: &Task<'_>, added: &[Added]) -> Result<Judged, ModelError> {
    match arguments.estimator {
        Method::Gls => task.fit(added),
        Method::Paper => task.judge(fit_paper(task.campaign, task.data)?.into_fit(task.campaign)?, None),
    }
}

fn origin(path: &Path, data: &Dataset) -> Result<DataOrigin, Failure> {
    Ok(DataOrigin {
        file: data.source.clone(),
        sha256: content_hash(path)?,
        readings: data.observations.len(),
    })
}
