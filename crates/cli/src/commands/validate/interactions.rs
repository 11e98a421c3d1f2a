//! `hexbench validate interactions`.

use clap::Args;
use hexbench_experiments::interactions::{Interactions, InteractionsProtocol, SEED, TRIPLES, page};
use hexbench_report::render::markdown;

use crate::failure::Failure;
use crate::output::{OutFile, Screen, TrialFiles};
use crate::shared::{NamedWork, TrialCommand};

/// Check that the numbers are right when effects act together: all pairs, random triples, without noise
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate interactions")]
pub(crate) struct Arguments {
    /// Triples of effects beside every single one and every pair
    #[arg(long, value_name = "N", default_value_t = TRIPLES as u32, value_parser = clap::value_parser!(u32).range(0..=500))]
    triples: u32,
    /// Seed of every random number
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Write the study as a document too
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    /// Exit with 1 when a number is beyond its bound
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    kept: TrialFiles,
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        Ok(NamedWork::only(protocol(self)))
    }
}

fn protocol(arguments: &Arguments) -> InteractionsProtocol {
    InteractionsProtocol::new(arguments.seed, arguments.triples as usize)
}

/// Run the study, tell the figures, write the document.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let protocol = protocol(arguments);
    let gathered = arguments.kept.run(&protocol)?;
    let study = Interactions::of(protocol, gathered);
    let page = page(&study);
    screen.show(&page)?;
    if let Some(path) = &arguments.markdown {
        screen.write_to(path, &markdown(&page))?;
    }
    let broken = study.broken().count();
    if arguments.check && broken > 0 {
        return Err(Failure::Check(format!(
            "{broken} of {} sets are beyond their bounds",
            study.records.len()
        )));
    }
    Ok(())
}
