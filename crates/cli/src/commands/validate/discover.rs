//! `hexbench validate discover`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::discovery::{DiscoveryProtocol, SEED, page};

use super::written;
use crate::failure::Failure;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::sole_experiment;

/// Check that laws outside the catalogue are found if and only if they are present
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate discover --out discover")]
pub(crate) struct Arguments {
    /// Folder for the table of trials
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Number of campaigns with an effect outside the catalogue
    #[arg(long, value_name = "N", default_value_t = DiscoveryProtocol::default().outside)]
    outside: usize,
    /// Number of campaigns with an effect of the catalogue
    #[arg(long, value_name = "N", default_value_t = DiscoveryProtocol::default().listed)]
    listed: usize,
    /// Number of campaigns on clean machines
    #[arg(long, value_name = "N", default_value_t = DiscoveryProtocol::default().clean)]
    clean: usize,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(protocol);

fn protocol(arguments: &Arguments) -> DiscoveryProtocol {
    let Arguments { seed, outside, listed, clean, .. } = *arguments;
    DiscoveryProtocol { seed, outside, listed, clean }
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let (study, trials) = arguments.kept.study_and_table(protocol(arguments))?;
    let files = vec![written::csv_file(arguments.out.join("trials.csv"), &trials)?];
    written::write_and_show(files, page(&study), arguments.markdown.as_ref(), screen)
}
