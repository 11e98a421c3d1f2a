//! `hexbench study STUDY -o DIR`.

use std::path::PathBuf;

use clap::Args;
use hexbench_study::results::{self, CellStatistics};
use hexbench_study::{Journal, Runner, Study};

use crate::failure::Failure;
use crate::output::{Progress, Screen, report};

/// Sweep over choices of an experiment: how accuracy depends on noise, plan, poses, repeats, geometry, effect and size
#[derive(Debug, Args)]
#[command(
    after_help = "A run that is stopped or killed goes on where it was when the same command is given \
                        again, and ends with the same bytes."
)]
pub(crate) struct Arguments {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Folder for the journal, trials.parquet, cells.csv, the page and the charts
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
}

/// Run what is missing, write the results, tell them.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let study = Study::read(&arguments.study)?;
    let runner = Runner::new(study)?;
    let journal = Journal::open(&arguments.out, &runner)?;
    compute(&runner, &journal)?;
    let cells = write(&runner, &journal)?;
    screen.write(&format!("{} cells\n", cells.len()))
}

fn compute(runner: &Runner, journal: &Journal) -> Result<(), Failure> {
    let state = journal.state(runner)?;
    if state.damaged > 0 {
        let told = format!("{} damaged records of the journal are computed again", state.damaged);
        report::warn(&told, "Nothing, if the files were copied or the disk was full.");
    }
    let all = runner.study().all_trials();
    let open: u64 = state.pending.iter().map(|&n| runner.trials_of(n)).map(|t| t.end - t.start).sum();
    let progress = Progress::of(all, "trials").beginning_at(all - open);
    let done = journal.compute(runner, &state.pending, &|trials| progress.advance(trials));
    progress.done();
    Ok(done?)
}

fn write(runner: &Runner, journal: &Journal) -> Result<Vec<CellStatistics>, Failure> {
    let progress = Progress::of(runner.shards(), "shards written");
    let cells = results::write(runner, journal, &|| progress.advance(1));
    progress.done();
    Ok(cells?)
}
