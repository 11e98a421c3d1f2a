//! `hexbench challenge score DIR ANSWERS...`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::challenge::Challenge;
use hexbench_experiments::challenge::score::{leaderboard, page, score};
use hexbench_report::charts::ReportError;
use hexbench_report::render::html;

use super::refuse_unanswered;
use crate::failure::Failure;
use crate::output::{OutFile, Screen, write_json, write_markdown};

/// Compare answers with the truth: errors, coverage, proper scores, programs side by side
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench challenge score cases answers\n  \
    hexbench challenge score cases mine theirs --html leaderboard.html")]
pub(crate) struct Arguments {
    /// The challenge, with its sealed part
    challenge: PathBuf,
    /// Folders of answers, one for each program
    #[arg(required = true)]
    answers: Vec<PathBuf>,
    /// Write all figures and cases to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write the page to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    /// Write the leaderboard to FILE, with charts of ranking, calibration and power, as a single HTML file that needs no
    /// network
    #[arg(long, value_name = "FILE")]
    html: Option<OutFile>,
    /// Exit with 1 if any case of any program has no answer
    #[arg(long)]
    check: bool,
}

/// Score and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let challenge = Challenge::open(&arguments.challenge)?;
    let scores = score(&challenge, &arguments.answers)?;
    write_json(screen, arguments.json.as_ref(), &scores)?;
    let page = page(&scores);
    write_markdown(screen, arguments.markdown.as_ref(), &page)?;
    if let Some(path) = &arguments.html {
        screen.write_to(path, &html(&leaderboard(&scores)?).map_err(ReportError::from)?)?;
    }
    screen.show_unless([&arguments.json, &arguments.markdown, &arguments.html], || page)?;
    refuse_unanswered(arguments.check, scores.failed())
}
