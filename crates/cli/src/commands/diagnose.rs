//! `hexbench diagnose HEXAPOD DATA`.

use std::sync::Arc;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use hexbench_app::fit::diagnosed_model;
use hexbench_core::files::content_hash;
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::effects::term::Term;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{DiagnoseOptions, Diagnosis, DiagnosisStudy, diagnose_with};
use hexbench_model::results::discover::diagnose_with_proposal;
use hexbench_model::results::runs::WithOrigin;
use hexbench_report::table::run_sheet;
use hexbench_report::words::{ReportSubject, command_line};
use hexbench_report::{charts, words};

use crate::coverage::Coverage;
use crate::failure::Failure;
use crate::input;
use crate::output::{OutFile, PageFiles, Screen, report, write_json};
use crate::question::{Asked, Question};
use crate::read_as::ReadAs;

/// Identify the physical effect the model lacks, and show the held-out error drop
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench diagnose hexapod.toml measurements.csv --holdout holdout.csv --html report.html\n  \
    hexbench diagnose hexapod.toml measurements.csv --exclude 17 --json diagnosis.json\n  \
    hexbench diagnose hexapod.toml measurements.csv --coverage 95 -o model.toml\n  \
    hexbench diagnose hexapod.toml - < measurements.csv")]
pub(crate) struct Arguments {
    #[command(flatten)]
    question: Question,
    /// Keep every reading in the fit: suspect readings are reported, but not left out
    #[arg(long)]
    keep_all: bool,
    #[command(flatten)]
    read_as: ReadAs,
    #[command(flatten)]
    coverage: Coverage,
    /// Write diagnosis.json to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write the fitted model to FILE (model.toml), for predictions and corrected commands: that of the readings judged sound
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Write the readings to take next to FILE, as a run sheet: a table to fill in and to add to the measurements
    #[arg(long, value_name = "FILE")]
    next: Option<OutFile>,
    #[command(flatten)]
    page: PageFiles,
    /// Exit with 1 unless the verdict is this one
    #[arg(long, value_name = "VERDICT", num_args = 0..=1, require_equals = true, default_missing_value = "adequate", value_parser = verdict())]
    check: Option<Verdict>,
}

/// The verdicts by their words.
fn verdict() -> impl TypedValueParser<Value = Verdict> {
    PossibleValuesParser::new(Verdict::ALL.map(Verdict::word))
        .try_map(|word| Verdict::named(&word).ok_or("no verdict"))
}

/// Diagnose and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let asked = arguments.question.read(&arguments.read_as)?;
    let Asked { hexapod, data, holdout, terms, options } = &asked;
    let options = options.clone().with_keep_all(arguments.keep_all);
    let study = diagnose_with_proposal(hexapod, data, holdout.as_ref(), terms, &options)
        .map_err(Failure::of_model(&data.source))?;
    input::warn_of_stated_stiffness(hexapod, &study.diagnosis.parameters);
    let to_stdout = OutFile::any_is_stdout([&arguments.json, &arguments.next]) || arguments.page.to_stdout();
    if let Some(path) = &arguments.json {
        let run = arguments.question.origin(&asked)?;
        write_json(screen, Some(path), &WithOrigin { result: &study.diagnosis, run })?;
    }
    let subject = ReportSubject::of(hexapod, data, holdout.as_ref(), &study)
        .with_plus_minus(arguments.coverage.plus_minus())
        .with_saving(saving(arguments));
    arguments.page.write(screen, || Ok(charts::diagnosis(&subject, &arguments.question.provenance()?)?))?;
    if !to_stdout {
        screen.show(&words::diagnosis(&subject))?;
    }
    if let Some(path) = &arguments.output {
        let model = diagnosed_model(&study, data, content_hash(arguments.question.data())?)?;
        screen.write_to(path, &model.to_toml().map_err(Failure::in_file(path))?)?;
    }
    if let Some(path) = &arguments.next {
        write_next(path, subject.hexapod, &study, screen)?;
    }
    check(arguments.check, &study.diagnosis)
}

/// The readings proposed; where there are none, that is no failure of the diagnosis.
fn write_next(
    path: &OutFile,
    hexapod: &Hexapod,
    study: &DiagnosisStudy,
    screen: &Screen,
) -> Result<(), Failure> {
    match run_sheet::rows(&study.data, &study.diagnosis.next) {
        Ok(rows) => {
            let sheet = run_sheet::csv(hexapod, &rows).map_err(Failure::unwritable(path))?;
            screen.write_to(path, &sheet)
        }
        Err(none) => {
            report::warn(&format!("{} was not written: {none}", path.display()), none.next_step());
            Ok(())
        }
    }
}

/// The command that saves the fitted model; none where this one does.
fn saving(arguments: &Arguments) -> Option<String> {
    let question = &arguments.question;
    let mut words = vec!["hexbench diagnose".to_owned()];
    words.extend(question.words(&arguments.read_as));
    words.extend(question.left_out());
    words.extend(arguments.keep_all.then(|| "--keep-all".to_owned()));
    words.push("-o model.toml".to_owned());
    arguments.output.is_none().then(|| command_line(words.into_iter()))
}

/// Diagnose with these terms.
pub(crate) fn study(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiagnosisStudy, Failure> {
    let failed = Failure::of_model(&data.source);
    diagnose_with(hexapod, data, holdout, terms, options).map_err(failed)
}

fn check(expected: Option<Verdict>, diagnosis: &Diagnosis) -> Result<(), Failure> {
    let Some(expected) = expected.filter(|e| *e != diagnosis.verdict) else {
        return Ok(());
    };
    Err(Failure::Check(format!("the verdict is {}, not {}", diagnosis.verdict.word(), expected.word())))
}
