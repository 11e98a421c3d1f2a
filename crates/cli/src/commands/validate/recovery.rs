//! `hexbench validate recovery`.

use clap::Args;
use hexbench_experiments::recovery::document::page;
use hexbench_experiments::recovery::protocol::Recovery;
use hexbench_experiments::recovery::study::{RecoverySettings, RecoveryStudy};

use crate::failure::Failure;
use crate::output::{OutFile, Screen, TrialFiles, write_json, write_markdown};
use crate::shared::sole_experiment;

/// Hide effects in simulated campaigns, and check that they are identified with correct uncertainties
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate recovery")]
pub(crate) struct Arguments {
    /// Number of noisy campaigns, divided among springs, geometry and every effect
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    campaigns: u32,
    /// Number of diagnoses per effect
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    diagnoses: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Write all figures to FILE, or to standard output (-)
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write the page docs/results/recovery.md to FILE
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    /// Exit with 1 if a bound is exceeded
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(protocol);

fn protocol(arguments: &Arguments) -> Recovery {
    Recovery::new(RecoverySettings {
        campaigns: arguments.campaigns as usize,
        diagnoses: arguments.diagnoses as usize,
        seed: arguments.seed,
    })
}

/// Run the study, write its files, tell it.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let protocol = protocol(arguments);
    let study = RecoveryStudy::of(&protocol, &arguments.kept.run(&protocol)?);
    write_json(screen, arguments.json.as_ref(), &study)?;
    let page = page(&study);
    write_markdown(screen, arguments.markdown.as_ref(), &page)?;
    screen.show_unless([&arguments.json, &arguments.markdown], || page)?;
    check(arguments.check, &study)
}

fn check(asked: bool, study: &RecoveryStudy) -> Result<(), Failure> {
    match study.broken.first() {
        Some(first) if asked => {
            let others = study.broken.len() - 1;
            Err(Failure::Check(format!("{first} (and {others} more broken bounds)")))
        }
        _ => Ok(()),
    }
}
