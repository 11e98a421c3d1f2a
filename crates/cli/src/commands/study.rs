//! `hexbench study STUDY -o DIR`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::files::atomic_write;
use hexbench_report::png::png;
use hexbench_study::page::{self, Picture};
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
    /// Write the page to FILE too; its charts go to a folder beside it
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

/// Run what is missing, write the results, tell them.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let study = Study::read(&arguments.study)?;
    let runner = Runner::new(study)?;
    let journal = Journal::open(&arguments.out, &runner)?;
    compute(&runner, &journal)?;
    let cells = write(&runner, &journal)?;
    let charts = page::pictures(runner.study(), &cells)?;
    let text = |folder: &str| page::document(runner.study(), &cells, &charts, folder).to_markdown();
    write_page(&arguments.out.join("study.md"), &arguments.out.join("charts"), &text, &charts, screen)?;
    for (chart, png) in charts.iter().filter_map(|c| Some((c, png(&c.svg)?))) {
        write_bytes(&arguments.out.join("charts").join(format!("{}.png", chart.name)), &png)?;
    }
    if let Some(file) = &arguments.markdown {
        write_page(file, &file.with_extension(""), &text, &charts, screen)?;
    }
    screen.write(&page::summary(runner.study(), &cells).to_text())?;
    screen.write(&format!("\n{}\n", written(&arguments.out)))
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
