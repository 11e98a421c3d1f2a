//! `hexbench validate`: studies that say how far the bench itself can be trusted, one file each.

pub(crate) mod calibration;
pub(crate) mod discover;
pub(crate) mod discriminate;
pub(crate) mod interactions;
pub(crate) mod misread;
pub(crate) mod paper;
pub(crate) mod power;
pub(crate) mod recovery;
pub(crate) mod regress;
pub(crate) mod robustness;
pub(crate) mod sensors;
mod written;

use clap::Args;

use crate::failure::Failure;
use crate::output::Screen;

/// Check the bench itself: run the identification on simulated campaigns with a known truth
#[derive(Debug, Args)]
#[command(arg_required_else_help = true)]
#[command(after_help = "Examples:\n  \
    hexbench validate recovery\n  \
    hexbench validate calibration --out calibration --journal trials")]
pub(crate) struct Arguments {
    /// What to check.
    #[command(subcommand)]
    pub(crate) study: Study,
}

commands! {
    /// The studies.
    Study {
        Recovery(recovery),
        Paper(paper),
        Interactions(interactions),
        Calibration(calibration),
        Robustness(robustness),
        Misread(misread),
        Sensors(sensors),
        Discover(discover),
        Discriminate(discriminate),
        Power(power),
        Regress(regress),
    }
}

/// Run the study.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    arguments.study.run(screen)
}

/// The id of a registry that a user means; `what` the registry holds.
fn known(
    id: &str,
    what: &str,
    mut all: impl Iterator<Item = &'static str> + Clone,
) -> Result<&'static str, String> {
    let listed = all.clone();
    all.find(|known| *known == id)
        .ok_or_else(|| format!("{what} are {}", listed.collect::<Vec<_>>().join(", ")))
}
