//! `hexbench challenge lint ANSWER --case CASE`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::challenge::answer::{AnswerFault, AskedCase, Lint, lint};
use hexbench_report::{Block, Mood, Page, Section};

use crate::failure::Failure;
use crate::output::Screen;

/// Report every error in one answer, with its location and the correction; exit with 1 if the case would fail
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench challenge lint out --case cases/case-001\n  \
    hexbench challenge lint answers/mine/cases/case-001")]
pub(crate) struct Arguments {
    /// Folder of the answer: predictions.csv, parameters.json, diagnosis.json
    answer: PathBuf,
    /// Folder of the case, whose rows and columns the answer must have [default: take them from the answer]
    #[arg(long, value_name = "CASE")]
    case: Option<PathBuf>,
}

/// Look and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    if !arguments.answer.is_dir() {
        let cause = std::io::Error::new(std::io::ErrorKind::NotADirectory, "it is no folder");
        return Err(Failure::unreadable(&arguments.answer)(cause));
    }
    let case = arguments.case.as_deref().map(AskedCase::read).transpose()?;
    let found = lint(&arguments.answer, case);
    screen.show(&page(&found))?;
    match found.faults.len() {
        0 => Ok(()),
        1 => Err(Failure::Check(
            "one thing is wrong with the answer: the case would count as failed".to_owned(),
        )),
        n => Err(Failure::Check(format!(
            "{n} things are wrong with the answer: the case would count as failed"
        ))),
    }
}

fn page(found: &Lint) -> Page {
    let verdict = if found.faults.is_empty() {
        Block::colored(Mood::Good, "The answer can be read and scored.")
    } else {
        Block::colored(Mood::Bad, "The answer cannot be scored: the case would count as failed.")
    };
    let section =
        |title: &str, all: &[AnswerFault]| Section::new(title).list(all.iter().map(in_words)).unless_empty();
    Page::new("Answer to a case")
        .with(Section::lead().with(verdict))
        .with(section("Wrong", &found.faults))
        .with(section("Allowed, and perhaps not meant", &found.notes))
}

fn in_words(fault: &AnswerFault) -> String {
    if fault.next.is_empty() { fault.to_string() } else { format!("{fault}. next: {}", fault.next) }
}
