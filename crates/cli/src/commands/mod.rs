//! One file per subcommand, each with its `Arguments` and `run`.

pub(crate) mod campaign;
pub(crate) mod challenge;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod compensate;
pub(crate) mod completions;
pub(crate) mod demo;
pub(crate) mod design;
pub(crate) mod diagnose;
pub(crate) mod discover;
pub(crate) mod discriminate;
pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod gate;
pub(crate) mod init;
pub(crate) mod man;
pub(crate) mod poses;
pub(crate) mod power;
pub(crate) mod predict;
pub(crate) mod regress;
pub(crate) mod runs;
pub(crate) mod simulate;
pub(crate) mod stiffness;
pub(crate) mod study;
pub(crate) mod terms;
pub(crate) mod transient;
pub(crate) mod validate;
pub(crate) mod witness;
pub(crate) mod workbench;

use crate::args::{Cli, Command};
use crate::failure::Failure;
use crate::output::{self, Screen};
use crate::shared;

/// Run the subcommand.
pub(crate) fn run(cli: &mut Cli, screen: &Screen) -> Result<(), Failure> {
    output::set_quiet(cli.quiet);
    if shared::begin(&mut cli.command, screen)? {
        return Ok(());
    }
    match &cli.command {
        Command::Demo(arguments) => demo::run(arguments, screen),
        Command::Init(arguments) => init::run(arguments, screen),
        Command::Simulate(arguments) => simulate::run(arguments, screen),
        Command::Poses(arguments) => poses::run(arguments, screen),
        Command::Campaign(arguments) => campaign::run(arguments, screen),
        Command::Check(arguments) => check::run(arguments, screen),
        Command::Compare(arguments) => compare::run(arguments, screen),
        Command::Fit(arguments) => fit::run(arguments, screen),
        Command::Predict(arguments) => predict::run(arguments, screen),
        Command::Compensate(arguments) => compensate::run(arguments, screen),
        Command::Diagnose(arguments) => diagnose::run(arguments, screen),
        Command::Discover(arguments) => discover::run(arguments, screen),
        Command::Runs(arguments) => runs::run(arguments, screen),
        Command::Export(arguments) => export::run(arguments, screen),
        Command::Witness(arguments) => witness::run(arguments, screen),
        Command::Stiffness(arguments) => stiffness::run(arguments, screen),
        Command::Transient(arguments) => transient::run(arguments, screen),
        Command::Design(arguments) => design::run(arguments, screen),
        Command::Discriminate(arguments) => discriminate::run(arguments, screen),
        Command::Power(arguments) => power::run(arguments, screen),
        Command::Study(arguments) => study::run(arguments, screen),
        Command::Regress(arguments) => regress::run(arguments, screen),
        Command::Terms(arguments) => terms::run(arguments, screen),
        Command::Challenge(arguments) => challenge::run(arguments, screen),
        Command::Gate(arguments) => gate::run(arguments, screen),
        Command::Validate(arguments) => validate::run(arguments, screen),
        Command::Workbench(arguments) => workbench::run(arguments, screen),
        Command::Completions(arguments) => completions::run(arguments, screen),
        Command::Man(arguments) => man::run(arguments, screen),
    }
}
