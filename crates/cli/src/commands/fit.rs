//! `hexbench fit HEXAPOD DATA --add TERM -o model.toml`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hexbench_app::fit::{ToFit, added, fitted, model};
use hexbench_app::memory::Computation;
use hexbench_app::session::SessionFile;
use hexbench_core::files::content_hash;
use hexbench_model::application::model_file::Estimator;
use hexbench_model::inference::misread::AsMeant;
use hexbench_model::inference::selection::JudgedTask;
use hexbench_model::results::fit::FitReport;
use hexbench_model::results::runs::WithOrigin;
use hexbench_report::words::{fitted, session};

use crate::coverage::Coverage;
use crate::failure::Failure;
use crate::input::{self, MemoryLimit, TableNames};
use crate::output::{OutFile, Screen, origin, write_json};
use crate::read_as::ReadAs;

/// Fit leg stiffnesses and the effects you name, and save the model
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench fit hexapod.toml measurements.csv -o model.toml\n  \
    hexbench fit hexapod.toml measurements.csv --add base-compliance --holdout holdout.csv --coverage 95 -o model.toml\n  \
    hexbench fit hexapod.toml measurements.csv --holdout holdout.csv --session session.json")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Deflections or absolute poses: measurements.csv
    data: PathBuf,
    /// Add this effect to the leg springs; append `:richer` for its richer form, or `:` and a version that `hexbench
    /// terms TERM` lists; may be given several times
    #[arg(long, value_name = "TERM")]
    add: Vec<String>,
    /// Held-out readings to judge the fit
    #[arg(long, value_name = "FILE")]
    holdout: Option<PathBuf>,
    /// Method of estimation
    #[arg(long, value_enum, default_value_t = Method::Gls)]
    estimator: Method,
    /// A term file of your own (term/1); it is added to the model. May be given several times
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// Fit the model of a workbench session: its terms and formulas, without its excluded readings; the files must be those of the
    /// session, and are read as it reads them
    #[arg(long, value_name = "FILE", conflicts_with_all = ["add", "terms", "estimator", "changes"])]
    session: Option<PathBuf>,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    memory: MemoryLimit,
    #[command(flatten)]
    read_as: ReadAs,
    #[command(flatten)]
    coverage: Coverage,
    /// Write the model to FILE (model.toml)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Write the result as fit.json to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
}

/// Estimators by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Generalized least squares, weighted by the noise
    Gls,
    /// The paper's unweighted minimum-norm least squares; springs and deflections only
    Paper,
}

/// Fit, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let data = input::measurements(&hexapod, &arguments.data, &arguments.names)?;
    arguments.memory.refuse(Computation::Fit, &data)?;
    let holdout = input::given_measurements(&hexapod, arguments.holdout.as_deref(), &arguments.names)?;
    let session = SessionFile::given(
        arguments.session.as_deref(),
        [&arguments.hexapod, &arguments.data],
        arguments.holdout.as_deref(),
    )?;
    let read_as = match &session {
        Some(file) => ReadAs { changes: file.session.changes() },
        None => arguments.read_as.clone(),
    };
    let meant = AsMeant::of(&hexapod, &data, holdout.as_ref(), &read_as.changes);
    let (hexapod, data, holdout) = (&*meant.hexapod, &*meant.data, meant.holdout.as_deref());
    input::warn_of_misread(hexapod, data, &read_as);
    input::warn_of_holdout(data, holdout);
    let estimator = if arguments.estimator == Method::Paper { Estimator::Paper } else { Estimator::Gls };
    let asked = match &session {
        Some(file) => file.to_fit(hexapod, data)?,
        None => ToFit::named(
            hexapod,
            data,
            added(&arguments.add, input::user_terms(&arguments.terms)?, estimator)?,
        )?,
    };
    let task = JudgedTask { hexapod, data: &asked.data, campaign: &asked.campaign, holdout };
    let judged = fitted(&task, &asked.added, estimator)?;
    input::warn_of_stated_stiffness(hexapod, &judged.estimates().determined);
    if let Some(path) = &arguments.json {
        let of_machine = (hexapod, arguments.hexapod.as_path());
        let run = origin(of_machine, (data, &arguments.data), arguments.holdout.as_deref())?;
        let result = FitReport::of(&task, &judged, estimator).with_excluded(&asked.exclude);
        write_json(screen, Some(path), &WithOrigin { result: &result, run })?;
    }
    screen.show_unless([&arguments.json], || {
        let page = fitted::page(&task, &judged, estimator, arguments.coverage.plus_minus());
        page.with(session::left_out(&asked.exclude))
    })?;
    let Some(path) = &arguments.output else { return Ok(()) };
    let mut model = model(&task, &judged, estimator, content_hash(&arguments.data)?);
    model.data.read_as = read_as.names();
    model.data.excluded.clone_from(&asked.exclude);
    let text = model.to_toml().map_err(Failure::in_file(path))?;
    screen.write_to(path, &text)
}
