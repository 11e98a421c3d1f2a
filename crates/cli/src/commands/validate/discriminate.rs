//! `hexbench validate discriminate`.

use clap::Args;
use hexbench_experiments::discriminate::{
    CONFUSIONS, DiscriminateProtocol, Discrimination, PairTrials, SEED, page,
};
use hexbench_report::render::markdown;

use crate::failure::Failure;

use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::sole_experiment;

/// Check that the proposed readings separate effects, by taking them on simulated machines with a known truth
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate discriminate")]
pub(crate) struct Arguments {
    /// Number of campaigns per pair of effects
    #[arg(long, value_name = "N", default_value_t = DiscriminateProtocol::default().trials, value_parser = trials)]
    trials: usize,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    #[command(flatten)]
    kept: TrialFiles,
}

fn trials(text: &str) -> Result<usize, String> {
    const MOST: usize = 100_000;
    let known = text.parse().ok().filter(|n| (1..=MOST).contains(n));
    known.ok_or_else(|| format!("a whole number from 1 to {MOST}"))
}

sole_experiment!(pairs);

fn pairs(arguments: &Arguments) -> PairTrials<'static> {
    let protocol = DiscriminateProtocol { seed: arguments.seed, trials: arguments.trials };
    PairTrials { protocol, confusions: &CONFUSIONS }
}

/// Run the study, tell the figures, write the document.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let trials = pairs(arguments);
    let study = Discrimination::of(&trials, &arguments.kept.run(&trials)?);
    let page = page(&study);
    screen.show(&page)?;
    arguments.markdown.as_ref().map_or(Ok(()), |path| screen.write_with_folder(path, &markdown(&page)))
}
