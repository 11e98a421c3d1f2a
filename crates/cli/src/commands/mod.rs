//! One file per subcommand, each with its `Arguments` and `run`.

/// Declares commands, each a file with its `Arguments` and `run`.
macro_rules! commands {
    ($(#[$doc:meta])* $kind:ident { $($name:ident($module:ident)),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, clap::Subcommand)]
        pub(crate) enum $kind {
            $($name($module::Arguments)),+
        }

        impl $kind {
            /// Run the one that is asked for.
            fn run(&self, screen: &crate::output::Screen) -> Result<(), crate::failure::Failure> {
                match self {
                    $(Self::$name(arguments) => $module::run(arguments, screen),)+
                }
            }
        }
    };
}

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

use crate::args::Cli;
use crate::failure::Failure;
use crate::output::{self, Screen};
use crate::shared;

commands! {
    /// The subcommands, in the order of the help.
    Command {
        Demo(demo),
        Init(init),
        Simulate(simulate),
        Poses(poses),
        Campaign(campaign),
        Check(check),
        Compare(compare),
        Diagnose(diagnose),
        Discover(discover),
        Runs(runs),
        Fit(fit),
        Predict(predict),
        Compensate(compensate),
        Stiffness(stiffness),
        Transient(transient),
        Export(export),
        Witness(witness),
        Design(design),
        Discriminate(discriminate),
        Power(power),
        Study(study),
        Regress(regress),
        Terms(terms),
        Challenge(challenge),
        Gate(gate),
        Validate(validate),
        Workbench(workbench),
        Completions(completions),
        Man(man),
    }
}

/// Run the subcommand.
pub(crate) fn run(cli: &mut Cli, screen: &Screen) -> Result<(), Failure> {
    output::set_quiet(cli.quiet);
    if shared::begin(&mut cli.command, screen)? {
        return Ok(());
    }
    cli.command.run(screen)
}
