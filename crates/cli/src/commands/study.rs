//! `hexbench study STUDY -o DIR`, and `plan`, `run`, `merge` to share it among machines.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, value_parser};
use hexbench_experiments::harness::{ExperimentPart, Progress as _};
use hexbench_experiments::sweep::work::Share;
use hexbench_experiments::sweep::{Work, divide, page};
use hexbench_report::{Block, Page, Section, Table};

use crate::failure::Failure;
use crate::output::{OutPlace, Progress, Screen};
use crate::shared::warn_of_damaged;

/// Sweep over the choices in an experiment: how accuracy depends on noise, plan, poses, repeats, geometry, effect and
/// size
///
/// `hexbench study STUDY -o DIR` runs the whole study on this machine; `plan`, `run` and `merge` divide it among
/// several.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Examples:\n  \
                        hexbench study data/studies/poses-and-noise.toml --out study --markdown study.md\n\n\
                        After an interruption, the same command resumes the run and gives the same bytes."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Option<Action>,
    #[command(flatten)]
    whole: Option<Whole>,
}

/// How a study is shared among machines.
#[derive(Debug, Subcommand)]
enum Action {
    /// Show how a study divides into parts
    Plan(PlanArguments),
    /// Compute one part of a study, in its own folder
    Run(RunArguments),
    /// Merge the parts into the same bytes that a single machine gives
    Merge(MergeArguments),
}

/// All of a study on this machine.
#[derive(Debug, Args)]
struct Whole {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Folder for the journal, trials.parquet, cells.csv, the page and the charts
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Also write the page to FILE, and its charts to a folder next to it
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench study plan study.toml --parts 8")]
struct PlanArguments {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Number of parts
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=1000))]
    parts: u64,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench study run study.toml --shard 2/8 --out part-2")]
struct RunArguments {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Folder for the results of this part
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Which part, counted from 1, of how many: 2/8
    #[arg(long, value_name = "I/N")]
    shard: ExperimentPart,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench study merge study.toml part-1 part-2 --out study")]
struct MergeArguments {
    /// What was swept: study.toml
    study: PathBuf,
    /// Folders of the parts, in any order
    #[arg(required = true, value_name = "FOLDER")]
    parts: Vec<PathBuf>,
    /// Folder for the merged study: journal, trials.parquet, cells.csv, the page and the charts
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Also write the page to FILE, and its charts to a folder next to it
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
}

/// All of a study, or what belongs to sharing it.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    match (&arguments.action, &arguments.whole) {
        (Some(Action::Plan(a)), _) => plan(a, screen),
        (Some(Action::Run(a)), _) => part(a, screen),
        (Some(Action::Merge(a)), _) => merge(a, screen),
        (None, Some(a)) => whole(a, screen),
        (None, None) => Err(Failure::usage(
            "the name of the study is missing",
            "Name a study file and a folder: hexbench study study.toml -o DIR.",
        )),
    }
}

/// Run what is missing, write the results, tell them.
fn whole(arguments: &Whole, screen: &Screen) -> Result<(), Failure> {
    let work = Work::open(&arguments.study, &arguments.out)?;
    compute(&work, None)?;
    tell(&work, arguments.markdown.as_deref().map(|file| &**file), screen)
}

/// Who does how much.
fn plan(arguments: &PlanArguments, screen: &Screen) -> Result<(), Failure> {
    let division = divide(&arguments.study, arguments.parts)?;
    let share = |share: &Share| [share.part.clone(), share.shards.to_string(), share.trials.to_string()];
    let table = Table::named(["part", "shards", "trials"]).rows(division.parts.iter().map(share));
    let study = arguments.study.display();
    let commands = format!(
        "hexbench study run {study} -o part-I --shard I/{}\nhexbench study merge {study} -o whole part-*",
        arguments.parts
    );
    let parts = Section::new(format!("{} shards, {} trials", division.shards, division.trials))
        .remark("every n-th shard, so that parts take equally long")
        .table(table);
    let next = Section::new("On each machine, then on one").with(Block::code(commands));
    screen.show(&Page::default().with(parts).with(next))
}

/// Compute what is missing of a part.
fn part(arguments: &RunArguments, screen: &Screen) -> Result<(), Failure> {
    let work = Work::open(&arguments.study, &arguments.out)?;
    compute(&work, Some(arguments.shard))?;
    let (part, folder) = (arguments.shard, arguments.out.display());
    screen
        .tell(&format!("Part {part} is done, in {folder}. `hexbench study merge` puts the parts together.\n"))
}

/// Take over all parts and write the results.
fn merge(arguments: &MergeArguments, screen: &Screen) -> Result<(), Failure> {
    let work = Work::open(&arguments.study, &arguments.out)?;
    for folder in &arguments.parts {
        let next = "`hexbench study run` on this folder computes them again.";
        warn_of_damaged(folder, work.journal().adopt(folder)?, next);
    }
    work.require_complete()?;
    tell(&work, arguments.markdown.as_deref().map(|file| &**file), screen)
}

/// Write the results of a study that is complete, and tell them.
fn tell(work: &Work, markdown: Option<&Path>, screen: &Screen) -> Result<(), Failure> {
    let progress = Progress::of(work.shards().count(), "shards written");
    let cells = work.write_tables(&|| progress.advance(1));
    progress.done();
    let cells = cells?;
    page::write(work.study(), &cells, work.folder(), markdown)?;
    screen.show(&page::summary(work.study(), &cells))?;
    let written: Vec<String> = work.written().iter().map(|path| format!("  {}\n", path.display())).collect();
    screen.tell(&format!("\nWritten:\n{}", written.concat()))
}

/// Compute what is missing of a part, or of the whole.
fn compute(work: &Work, part: Option<ExperimentPart>) -> Result<(), Failure> {
    let progress = Progress::of(0, "trials");
    let damaged = work.todo(part)?.damaged;
    progress.damaged(damaged);
    Ok(work.finish(part, &progress, &|todo| progress.begin(todo.trials, todo.trials - todo.pending_trials))?)
}
