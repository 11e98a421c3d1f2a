//! `hexbench study STUDY -o DIR`, and `plan`, `run`, `merge` to share it among machines.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, value_parser};
use hexbench_core::files::atomic_write;
use hexbench_pages::text::{Paper, Table};
use hexbench_report::png::png;
use hexbench_study::page::{self, Picture};
use hexbench_study::results::{self, CellStatistics};
use hexbench_study::{Journal, Part, Runner, Study, StudyError};

use crate::failure::Failure;
use crate::output::{Progress, Screen, report};

/// Sweep over choices of an experiment: how accuracy depends on noise, plan, poses, repeats, geometry, effect and size
///
/// `hexbench study STUDY -o DIR` does all of it on this machine; `plan`, `run` and `merge` share it among several.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "A run that is stopped or killed goes on where it was when the same command is given \
                        again, and ends with the same bytes."
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
    /// Tell how a study divides into parts
    Plan(PlanArguments),
    /// Compute one part of a study into a folder of its own
    Run(RunArguments),
    /// Put the parts together: the same bytes as one machine gives
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
    /// Write the page to FILE too; its charts go to a folder beside it
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct PlanArguments {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Number of parts
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=1000))]
    parts: u64,
}

#[derive(Debug, Args)]
struct RunArguments {
    /// What to sweep: study.toml
    study: PathBuf,
    /// Folder for what this part has done
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Which part of how many, from 1: 2/8
    #[arg(long, value_name = "I/N")]
    shard: Part,
}

#[derive(Debug, Args)]
struct MergeArguments {
    /// What was swept: study.toml
    study: PathBuf,
    /// Folders of the parts, in any order
    #[arg(required = true, value_name = "FOLDER")]
    parts: Vec<PathBuf>,
    /// Folder for the whole: journal, trials.parquet, cells.csv, the page and the charts
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Write the page to FILE too; its charts go to a folder beside it
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

/// All of a study, or what belongs to sharing it.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    match (&arguments.action, &arguments.whole) {
        (Some(Action::Plan(a)), _) => plan(a, screen),
        (Some(Action::Run(a)), _) => part(a, screen),
        (Some(Action::Merge(a)), _) => merge(a, screen),
        (None, Some(a)) => whole(a, screen),
        (None, None) => Err(Failure::Usage {
            message: "no study is named".into(),
            next: "Name a study file and a folder: hexbench study study.toml -o DIR.".into(),
        }),
    }
}

/// Run what is missing, write the results, tell them.
fn whole(arguments: &Whole, screen: &Screen) -> Result<(), Failure> {
    let runner = Runner::new(Study::read(&arguments.study)?)?;
    let journal = Journal::open(&arguments.out, &runner)?;
    compute(&runner, &journal, |_| true)?;
    tell(&runner, &journal, arguments.markdown.as_deref(), screen)
}

/// Who does how much.
fn plan(arguments: &PlanArguments, screen: &Screen) -> Result<(), Failure> {
    let runner = Runner::new(Study::read(&arguments.study)?)?;
    let mut table = Table::default();
    table.row(["part", "shards", "trials"]);
    for part in Part::all(arguments.parts) {
        let own: Vec<u64> = (0..runner.shards()).filter(|&n| part.holds(n)).collect();
        table.row([part.to_string(), own.len().to_string(), trials(&runner, &own).to_string()]);
    }
    let mut paper = Paper::new(screen.ink());
    let study = arguments.study.display();
    let (shards, trials) = (runner.shards(), runner.study().all_trials());
    paper.heading(
        &format!("{shards} shards, {trials} trials"),
        "every n-th shard, so that parts take equally long",
    );
    table.lines().iter().for_each(|line| paper.line(line));
    paper.heading("On each machine, then on one", "");
    paper.line(&format!("  hexbench study run {study} -o part-I --shard I/{}", arguments.parts));
    paper.line(&format!("  hexbench study merge {study} -o whole part-*"));
    screen.write(&paper.into_text())
}

/// Compute what is missing of a part.
fn part(arguments: &RunArguments, screen: &Screen) -> Result<(), Failure> {
    let runner = Runner::new(Study::read(&arguments.study)?)?;
    let journal = Journal::open(&arguments.out, &runner)?;
    compute(&runner, &journal, |shard| arguments.shard.holds(shard))?;
    let (part, folder) = (arguments.shard, arguments.out.display());
    screen.write(&format!(
        "Part {part} is done, in {folder}. `hexbench study merge` puts the parts together.\n"
    ))
}

/// Take over all parts and write the results.
fn merge(arguments: &MergeArguments, screen: &Screen) -> Result<(), Failure> {
    let runner = Runner::new(Study::read(&arguments.study)?)?;
    let journal = Journal::open(&arguments.out, &runner)?;
    for folder in &arguments.parts {
        let adopted = journal.adopt(&runner, folder)?;
        if adopted.damaged > 0 {
            let told = format!("{}: {} records are damaged and left out", folder.display(), adopted.damaged);
            report::warn(&told, "`hexbench study run` on this folder computes them again.");
        }
    }
    let pending = journal.state(&runner)?.pending;
    if let Some(&first) = pending.first() {
        let missing = pending.len() as u64;
        return Err(StudyError::Incomplete { missing, first, all: runner.shards() }.into());
    }
    tell(&runner, &journal, arguments.markdown.as_deref(), screen)
}

/// Write the results of a study that is complete, and tell them.
fn tell(runner: &Runner, journal: &Journal, markdown: Option<&Path>, screen: &Screen) -> Result<(), Failure> {
    let out = journal.folder();
    let cells = write(runner, journal)?;
    let charts = page::pictures(runner.study(), &cells)?;
    let text = |folder: &str| page::document(runner.study(), &cells, &charts, folder).to_markdown();
    write_page(&out.join("study.md"), &out.join("charts"), &text, &charts, screen)?;
    for (chart, png) in charts.iter().filter_map(|c| Some((c, png(&c.svg)?))) {
        write_bytes(&out.join("charts").join(format!("{}.png", chart.name)), &png)?;
    }
    if let Some(file) = markdown {
        write_page(file, &file.with_extension(""), &text, &charts, screen)?;
    }
    screen.write(&page::summary(runner.study(), &cells).to_text())?;
    screen.write(&format!("\n{}\n", written(out)))
}

/// The page and its charts as SVG, which are in `folder` beside it.
fn write_page(
    file: &Path,
    folder: &Path,
    text: &dyn Fn(&str) -> String,
    charts: &[Picture],
    screen: &Screen,
) -> Result<(), Failure> {
    let beside = folder.file_name().unwrap_or_default().to_string_lossy();
    Screen::make_folder_of(file)?;
    screen.write_to(file, &text(&beside))?;
    for chart in charts {
        let path = folder.join(format!("{}.svg", chart.name));
        Screen::make_folder_of(&path)?;
        screen.write_to(&path, &chart.svg)?;
    }
    Ok(())
}

fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    atomic_write(path, |out| out.write_all(bytes))
        .map_err(|cause| Failure::Output { path: path.to_owned(), cause })
}

fn written(out: &Path) -> String {
    let at = |name: &str| format!("  {}", out.join(name).display());
    ["Written:".to_owned(), at("study.md"), at(results::CELLS), at(results::TRIALS), at("charts")].join("\n")
}

/// Trials in these shards.
fn trials(runner: &Runner, shards: &[u64]) -> u64 {
    shards.iter().map(|&n| runner.trials_of(n)).map(|t| t.end - t.start).sum()
}

/// Compute what is missing of the shards that are wanted.
fn compute(runner: &Runner, journal: &Journal, wanted: impl Fn(u64) -> bool) -> Result<(), Failure> {
    let state = journal.state(runner)?;
    if state.damaged > 0 {
        let told = format!("{} damaged records of the journal are computed again", state.damaged);
        report::warn(&told, "Nothing, if the files were copied or the disk was full.");
    }
    let own: Vec<u64> = (0..runner.shards()).filter(|&n| wanted(n)).collect();
    let pending: Vec<u64> = state.pending.into_iter().filter(|&n| wanted(n)).collect();
    let all = trials(runner, &own);
    let progress = Progress::of(all, "trials").beginning_at(all - trials(runner, &pending));
    let done = journal.compute(runner, &pending, &|trials| progress.advance(trials));
    progress.done();
    Ok(done?)
}

fn write(runner: &Runner, journal: &Journal) -> Result<Vec<CellStatistics>, Failure> {
    let progress = Progress::of(runner.shards(), "shards written");
    let cells = results::write(runner, journal, &|| progress.advance(1));
    progress.done();
    Ok(cells?)
}
