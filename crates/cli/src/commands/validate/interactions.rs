//! `hexbench validate interactions`.

use clap::Args;
use hexbench_experiments::interactions::{Interactions, InteractionsProtocol, SEED, TRIPLES, page};

use crate::failure::Failure;
use crate::output::{OutFile, Screen, TrialFiles, write_markdown};
use crate::shared::sole_experiment;

/// Check that parameters are correct when effects act together: all pairs and random triples, without noise
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate interactions")]
pub(crate) struct Arguments {
    /// Number of triples of effects, in addition to all single effects and pairs
    #[arg(long, value_name = "N", default_value_t = TRIPLES as u32, value_parser = clap::value_parser!(u32).range(0..=500))]
    triples: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    /// Exit with 1 if a number exceeds its bound
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(protocol);

fn protocol(arguments: &Arguments) -> InteractionsProtocol {
    InteractionsProtocol::new(arguments.seed, arguments.triples as usize)
}

/// Run the study, tell the figures, write the document.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let protocol = protocol(arguments);
    let gathered = arguments.kept.run(&protocol)?;
    let study = Interactions::of(protocol, gathered);
    let page = page(&study);
    write_markdown(screen, arguments.markdown.as_ref(), &page)?;
    screen.show_unless([&arguments.markdown], || page)?;
    let broken = study.broken().count();
    if arguments.check && broken > 0 {
        return Err(Failure::Check(format!(
            "{broken} of {} sets are beyond their bounds",
            study.records.len()
        )));
    }
    Ok(())
}
