//! `hexbench challenge run DIR -o ANSWERS --name NAME -- PROGRAM ARGS...`.

use std::path::PathBuf;

use clap::{Args, value_parser};
use hexbench_experiments::challenge::Challenge;
use hexbench_experiments::challenge::run::{Manner, Summary, failures, of_part, run as run_cases, take_over};

use super::options::{RunOptions, ShareOptions};
use super::refuse_unanswered;
use crate::failure::Failure;
use crate::output::{Progress, Screen};

/// Run a program over the cases, each in a fresh folder and under limits of time, memory and output
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
                        hexbench challenge run cases --out answers --name mine -- python3 solve.py\n\n\
                        The case folder and the folder for the answer are appended to the arguments of the program. After an \
                        interruption, the same command resumes the run. The limits apply on Linux; other Unix systems limit \
                        memory only per process, as far as they support it.")]
pub(crate) struct Arguments {
    /// The challenge
    challenge: PathBuf,
    /// Folder for the answers
    #[arg(short = 'o', long, value_name = "ANSWERS")]
    out: PathBuf,
    /// Name in the tables
    #[arg(long)]
    name: String,
    /// Number of cases run at the same time; times are comparable only with 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// Answer all cases again
    #[arg(long, conflicts_with = "parts")]
    again: bool,
    /// Exit with 1 if any case has no answer
    #[arg(long, conflicts_with = "parts")]
    check: bool,
    #[command(flatten)]
    share: ShareOptions,
    #[command(flatten)]
    options: RunOptions,
    /// The program and its own arguments
    #[arg(last = true, required = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

/// Run what is missing, tell what failed.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let challenge = Challenge::open(&arguments.challenge)?;
    let entrant = arguments.options.entrant(&arguments.name, &arguments.program)?;
    let manner = Manner { jobs: usize::from(arguments.jobs), again: arguments.again };
    let ShareOptions { shard, parts } = &arguments.share;
    if !parts.is_empty() {
        let summary = take_over(&challenge, &entrant, &arguments.out, parts, false, &|_| true)?;
        return screen.tell(&taken_over(&summary, &entrant.name));
    }
    let progress = Progress::of(0, "cases");
    let own = shard.map(|part| of_part(&challenge, part));
    let is_own = |id: &str| own.as_ref().is_none_or(|own| own(id));
    let summary = run_cases(&challenge, &entrant, &arguments.out, manner, &is_own, &progress);
    progress.done();
    let summary = summary?;
    let [earlier, failed] =
        [&summary.earlier, &summary.fresh].map(|records| failures(&challenge, &arguments.out, records));
    screen.tell(&in_words(&summary, [&earlier, &failed], &entrant.name))?;
    refuse_unanswered(arguments.check, earlier.len() + failed.len())
}

fn taken_over(summary: &Summary, name: &str) -> String {
    format!("{name}: {} answers taken over, {} were here.\n", summary.fresh.len(), summary.earlier.len())
}

/// `failed`: of former runs, and of this one.
fn in_words(summary: &Summary, [earlier, failed]: [&[(&str, String)]; 2], name: &str) -> String {
    let of_which = match earlier.len() {
        0 => String::new(),
        failed => format!(", of which {failed} failed"),
    };
    let head = format!(
        "{name}: {} cases answered, {} failed, {} answered before{of_which}.\n",
        summary.fresh.len() - failed.len(),
        failed.len(),
        summary.earlier.len()
    );
    let lines = earlier.iter().chain(failed).map(|(case, why)| format!("  {case}: {why}\n"));
    let again = (!earlier.is_empty())
        .then(|| "Cases that failed before were not run again; --again answers all cases anew.\n".to_owned());
    std::iter::once(head).chain(lines).chain(again).collect()
}
