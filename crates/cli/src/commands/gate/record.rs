//! `hexbench gate record SUITE -- PROGRAM ARGS...`.

use std::path::PathBuf;

use clap::{Args, value_parser};
use hexbench_experiments::gate::cases::update;
use hexbench_experiments::gate::work::WorkFolder;
use hexbench_experiments::gate::{GateBaseline, GateEntrant, GateSuite, GateWork, page};

use super::{BASELINE, GateFunction, NAME, share};
use crate::commands::challenge::options::{RunOptions, ShareOptions};
use crate::failure::Failure;
use crate::output::{OutPlace, Progress, Screen};

/// Run a program over the cases of a suite several times, and save its scores as the baseline
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench gate record springs-and-effects -- python3 solve.py\n  \
    hexbench gate record suite.toml --repeats 8 --depends src -- ./solve --fast\n  \
    hexbench gate record suite.toml --shard 2/8 --work part-2 -- ./solve\n  \
    hexbench gate record suite.toml --parts part-1 part-2 -- ./solve\n\n\
    The baseline is small; commit it. It contains the suite, the scores of every case and the digests of the program's files.")]
pub(crate) struct Arguments {
    /// A bundled suite (springs-and-effects), a suite file, or the folder of a challenge with its sealed part
    suite: String,
    /// Write the baseline to FILE
    #[arg(long, value_name = "FILE", default_value = BASELINE)]
    baseline: OutPlace,
    /// A seed other than that of the suite
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Number of runs over all cases: their scatter determines how small a change can be detected
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u16).range(1..=100))]
    repeats: u16,
    /// Number of cases run at the same time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// Folder in which to keep cases and answers for inspection [default: a temporary folder]; the program always
    /// runs again
    #[arg(long, value_name = "DIR")]
    work: Option<PathBuf>,
    #[command(flatten)]
    share: ShareOptions,
    /// Reason for the baseline; stored in it
    #[arg(long, value_name = "TEXT", default_value = "The first baseline.")]
    reason: String,
    #[command(flatten)]
    options: RunOptions,
    /// The program and its own arguments
    #[arg(last = true, required = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

/// Record, and say what would be noticed.
pub(crate) fn run(
    arguments: &Arguments,
    screen: &Screen,
    function: Option<&GateFunction<'_>>,
) -> Result<(), Failure> {
    let next = format!(
        "Change it with `{}`, or name another.",
        update(function.is_some_and(|function| function.program.is_some()))
    );
    Screen::refuse_existing(&arguments.baseline, &next)?;
    let entrant = match function.and_then(|function| function.program.as_ref()) {
        Some(program) => arguments.options.inside(NAME, program)?,
        None => arguments.options.entrant(NAME, &arguments.program)?,
    };
    let share = arguments.share.of_gate(arguments.work.as_deref())?;
    let work = WorkFolder::at(arguments.work.as_deref())?;
    let progress = Progress::of(0, "cases");
    let (suite, challenge) = GateSuite::open(&arguments.suite, arguments.seed, work.path(), &progress)?;
    let at_work = GateWork::new(&challenge, &entrant, work.path(), usize::from(arguments.jobs), &progress)?;
    let at_work = at_work.by(function.map(|f| f.function)).with_share(share);
    let (runs, part) = (at_work.runs(usize::from(arguments.repeats)), share::answered(&at_work));
    progress.done();
    let runs = runs?;
    if let Some(said) = part {
        return screen.tell(&said);
    }
    let depends: Vec<String> = arguments.options.depends.iter().map(|p| p.display().to_string()).collect();
    let kept = GateEntrant::of(&arguments.program, &depends, &entrant)?;
    let baseline = GateBaseline::of((suite, &challenge), kept, &runs, (&arguments.reason, Vec::new()))?;
    Screen::make_folder_of(&arguments.baseline)?;
    baseline.write(&arguments.baseline)?;
    screen.show(&page::recorded(&baseline))
}
