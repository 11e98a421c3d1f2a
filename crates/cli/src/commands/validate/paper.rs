//! `hexbench validate paper`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::paper::{Again, Reproduction, report};

use crate::failure::Failure;
use crate::output::{Screen, TrialFiles};
use crate::shared::{NamedWork, TrialCommand};

/// Repeat the paper on a simulated machine: its tables next to ours, and the sources of its remaining error
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate paper")]
pub(crate) struct Arguments {
    /// Seed of the noise
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Folder for the page, the charts, the readings, and the numbers of every table and figure
    #[arg(short = 'o', long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    kept: TrialFiles,
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        Ok(NamedWork::only(Again::of(self.seed)?))
    }
}

/// Run the study, print the page, write the files.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let study = Reproduction::run(arguments.seed, |again| arguments.kept.run(again))?;
    if let Some(folder) = &arguments.out {
        for (name, text) in report::files(&study)? {
            screen.write_into(folder, &name, &text)?;
        }
    }
    screen.show(&report::page(&study))
}
