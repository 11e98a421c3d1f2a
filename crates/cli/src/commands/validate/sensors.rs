//! `hexbench validate sensors`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::harness;
use hexbench_experiments::sensors::{SEED, SensorProtocol, SensorStudy, TRIALS, page, table};
use hexbench_report::Section;
use hexbench_report::render::markdown;
use hexbench_report::table::csv;

use super::written;
use crate::failure::Failure;
use crate::output::{Screen, TrialFiles};

/// Say what becomes of campaigns read with gauges, balls, levels or scales instead of full poses, and of sensors that are wrong
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder for the table of trials and the summary table
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Campaigns of each way of reading and of each fault: on a clean machine and with one effect in turn
    #[arg(long, value_name = "N", default_value_t = TRIALS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Seed of everything that is drawn
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Write the study as a document too
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    #[command(flatten)]
    kept: TrialFiles,
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let protocol = SensorProtocol { seed: arguments.seed, trials: arguments.trials as usize };
    let gathered = arguments.kept.run(&protocol)?;
    let trials = harness::table(&protocol, &gathered);
    let study = SensorStudy::of(protocol, gathered);
    let out = |name: &str| arguments.out.join(name);
    let mut files =
        vec![written::csv_file(out("trials.csv"), &trials)?, (out("ways.csv"), csv::text(&table(&study)))];
    files.extend(arguments.markdown.iter().map(|path| (path.clone(), markdown(&page(&study)))));
    let written = written::write_all(files, screen)?;
    let names = written.iter().map(|path| path.display().to_string());
    screen.show(&page(&study).with(Section::new("Written").list(names)))
}
