//! `hexbench runs A.json B.json`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_model::results::runs::{FORMATS, Head, Run, SavedComparison, SavedDiagnosis, between};
use hexbench_report::{charts, words};
use serde::de::DeserializeOwned;

use crate::failure::Failure;
use crate::output::{OutFile, PageFiles, Screen, provenance, write_json};

/// Compare two results and flag statistically significant changes
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench runs before.json after.json")]
pub(crate) struct Arguments {
    /// First result: written by `diagnose --json` or `compare --json`
    a: PathBuf,
    /// Second result, of the same kind and machine
    b: PathBuf,
    /// Write all numbers to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    #[command(flatten)]
    page: PageFiles,
    /// Exit with 1 when anything changed: the answer, or a number significantly
    #[arg(long)]
    check: bool,
}

/// Compare and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let runs = between(read(&arguments.a)?, read(&arguments.b)?).map_err(Failure::Runs)?;
    if let Some(path) = &arguments.json {
        write_json(screen, path, &runs)?;
    }
    arguments.page.write(screen, || Ok(charts::runs(&runs, &provenance([&arguments.a, &arguments.b])?)?))?;
    if !arguments.json.as_ref().is_some_and(OutFile::is_stdout) {
        screen.show(&words::runs(&runs))?;
    }
    if arguments.check && runs.has_changed() {
        return Err(Failure::Check("the two runs differ".to_owned()));
    }
    Ok(())
}

fn read(path: &Path) -> Result<Run, Failure> {
    let unreadable = |cause| Failure::Unreadable { path: path.to_owned(), cause };
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    let file = path.display().to_string();
    let format = parsed::<Head>(path, &text)?.format;
    match format.as_str() {
        "diagnosis/1" => Ok(Run::of_diagnosis(&file, parsed::<SavedDiagnosis>(path, &text)?)),
        "comparison/1" => Ok(Run::of_comparison(&file, parsed::<SavedComparison>(path, &text)?)),
        _ => {
            let cause = format!("format {format:?} is not read here, only {}", FORMATS.join(" and "));
            Err(Failure::Result { path: path.to_owned(), cause })
        }
    }
}

fn parsed<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, Failure> {
    let failed = |e: serde_json::Error| Failure::Result { path: path.to_owned(), cause: e.to_string() };
    serde_json::from_str(text).map_err(failed)
}
