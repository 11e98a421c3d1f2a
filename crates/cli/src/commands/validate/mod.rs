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

use clap::{Args, Subcommand};

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

/// The studies: one file here and one line here and in [`run`] each.
#[derive(Debug, Subcommand)]
pub(crate) enum Study {
    Recovery(recovery::Arguments),
    Paper(paper::Arguments),
    Interactions(interactions::Arguments),
    Calibration(calibration::Arguments),
    Robustness(robustness::Arguments),
    Misread(misread::Arguments),
    Sensors(sensors::Arguments),
    Discover(discover::Arguments),
    Discriminate(discriminate::Arguments),
    Power(power::Arguments),
    Regress(regress::Arguments),
}

/// Run the study.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    match &arguments.study {
        Study::Recovery(arguments) => recovery::run(arguments, screen),
        Study::Paper(arguments) => paper::run(arguments, screen),
        Study::Interactions(arguments) => interactions::run(arguments, screen),
        Study::Calibration(arguments) => calibration::run(arguments, screen),
        Study::Robustness(arguments) => robustness::run(arguments, screen),
        Study::Misread(arguments) => misread::run(arguments, screen),
        Study::Sensors(arguments) => sensors::run(arguments, screen),
        Study::Discover(arguments) => discover::run(arguments, screen),
        Study::Discriminate(arguments) => discriminate::run(arguments, screen),
        Study::Power(arguments) => power::run(arguments, screen),
        Study::Regress(arguments) => regress::run(arguments, screen),
    }
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
