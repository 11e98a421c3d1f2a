//! `hexbench runs A.json B.json`, `hexbench runs A.json B.json C.json ...`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::parser_words::of_json;
use hexbench_model::results::book::{CampaignBook, CampaignDay, DatedRun, book};
use hexbench_model::results::runs::{
    ComparedRuns, FORMATS, Head, Run, SavedComparison, SavedDiagnosis, SavedFit, between,
};
use hexbench_report::{charts, words};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::failure::Failure;
use crate::output::{OutFile, PageFiles, Screen, TableFile, provenance, write_json};
use crate::page::book_table;

/// Compare two results and flag statistically significant changes, or make a campaign book of three or more
///
/// Three or more results of one machine become a campaign book: control charts of the stiffness of each leg, the size of each effect and
/// the held-out error, with bands from the stated uncertainties. The page begins with what changed, how certain that is, and what to do.
/// If nothing changes, at most one book in a hundred raises any alarm.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench runs before.json after.json\n  \
    hexbench runs jan.json feb.json mar.json --dates 2026-01-12,2026-02-09,2026-03-10 --html book.html --table book.csv")]
pub(crate) struct Arguments {
    /// Results of one kind and one machine, written by `diagnose --json`, `fit --json` or `compare --json`
    #[arg(required = true, num_args = 2.., value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// Dates of a book, one per result, as 2026-01-31; they order the book, which otherwise keeps the order of the
    /// results
    #[arg(long, value_name = "DATES", value_delimiter = ',')]
    dates: Vec<CampaignDay>,
    /// Write all numbers to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write one row per number and campaign of a book to FILE (.parquet or .csv)
    #[arg(long, value_name = "FILE")]
    table: Option<TableFile>,
    #[command(flatten)]
    page: PageFiles,
    /// Exit with 1 if the answer changed, or a number changed significantly; in a book, only numbers count
    #[arg(long)]
    check: bool,
}

/// Compare and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let runs = arguments.results.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
    match <[Run; 2]>::try_from(runs) {
        Ok([a, b]) => {
            arguments.refuse_what_books_have()?;
            arguments.two(&between(a, b)?, screen)
        }
        Err(runs) => arguments.book(&book(arguments.dated(runs)?)?, screen),
    }
}

impl Arguments {
    fn two(&self, runs: &ComparedRuns, screen: &Screen) -> Result<(), Failure> {
        self.write(runs, screen)?;
        self.page.write(screen, || Ok(charts::runs(runs, &provenance(&self.results)?)?))?;
        if self.shows_page() {
            screen.show(&words::runs(runs))?;
        }
        self.checked(runs.has_changed(), "the two runs differ")
    }

    fn book(&self, book: &CampaignBook, screen: &Screen) -> Result<(), Failure> {
        self.write(book, screen)?;
        if let Some(table) = &self.table {
            table.write(book_table::frame(book), &self.results)?;
        }
        self.page.write(screen, || Ok(charts::book(book, &provenance(&self.results)?)?))?;
        if self.shows_page() {
            screen.show(&words::book(book))?;
        }
        self.checked(book.is_alarmed(), "the machine changed")
    }

    fn write(&self, result: &impl Serialize, screen: &Screen) -> Result<(), Failure> {
        write_json(screen, self.json.as_ref(), result)
    }

    fn shows_page(&self) -> bool {
        !OutFile::any_is_stdout([&self.json])
    }

    fn checked(&self, changed: bool, failure: &str) -> Result<(), Failure> {
        if self.check && changed { Err(Failure::Check(failure.to_owned())) } else { Ok(()) }
    }

    fn refuse_what_books_have(&self) -> Result<(), Failure> {
        if self.dates.is_empty() && self.table.is_none() {
            return Ok(());
        }
        let next = "Name three or more results, or omit `--dates` and `--table`.";
        Err(Failure::usage("`--dates` and `--table` are for campaign books only".to_owned(), next))
    }

    /// Every result with its date, when there are any.
    fn dated(&self, runs: Vec<Run>) -> Result<Vec<DatedRun>, Failure> {
        let (dates, results) = (self.dates.len(), runs.len());
        if dates != 0 && dates != results {
            let message = format!("`--dates` has {dates} dates for {results} results");
            return Err(Failure::usage(message, "Add one date per result, in the same order."));
        }
        let dated = |(k, run)| DatedRun { run, day: self.dates.get(k).copied() };
        Ok(runs.into_iter().enumerate().map(dated).collect())
    }
}

const HOW_TO_WRITE: &str =
    "`hexbench diagnose ... --json FILE` and `compare ... --json FILE` write such files.";

fn read(path: &Path) -> Result<Run, Failure> {
    let text = std::fs::read_to_string(path).map_err(Failure::unreadable(path))?;
    let file = path.display().to_string();
    let format = parsed::<Head>(path, &text)?.format;
    match format.as_str() {
        "diagnosis/1" => Ok(Run::of_diagnosis(&file, parsed::<SavedDiagnosis>(path, &text)?)),
        "comparison/1" => Ok(Run::of_comparison(&file, parsed::<SavedComparison>(path, &text)?)),
        "fit/1" => Ok(Run::of_fit(&file, parsed::<SavedFit>(path, &text)?)),
        _ => {
            let why = format!("format {format:?} is not read here, only {}", FORMATS.join(", "));
            Err(Failure::unusable(path, why, HOW_TO_WRITE))
        }
    }
}

fn parsed<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, Failure> {
    serde_json::from_str(text).map_err(|e| Failure::unusable(path, of_json(&e), HOW_TO_WRITE))
}
