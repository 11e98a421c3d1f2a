//! Arguments common to all subcommands, and the list of subcommands.

use clap::{Parser, Subcommand};

use crate::commands;
use crate::output::Colour;

/// Compare a hexapod's stiffness model with measurements, name the physical effect it lacks, add it, and watch the
/// error on held-out poses fall to the noise.
#[derive(Debug, Parser)]
#[command(name = "hexbench", version, max_term_width = 80, arg_required_else_help = true)]
#[command(after_help = "Exit codes: 0 done, 1 a requested check failed, 2 usage, 3 bad input, \
                        4 not determined by the data, 5 input or output")]
pub(crate) struct Cli {
    /// When to colour; `NO_COLOR` is respected by `auto`
    #[arg(
        long = "color",
        alias = "colour",
        value_name = "WHEN",
        default_value = "auto",
        global = true,
        display_order = 100
    )]
    pub(crate) colour: Colour,
    /// Every row, column and section of a page, details included
    #[arg(long, short, global = true, display_order = 101)]
    pub(crate) verbose: bool,
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The subcommands: one file in `commands/` and one line here and in [`crate::commands::run`] each.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(commands::demo::Arguments),
    Init(commands::init::Arguments),
    Simulate(commands::simulate::Arguments),
    Poses(commands::poses::Arguments),
    Campaign(commands::campaign::Arguments),
    Check(commands::check::Arguments),
    Compare(commands::compare::Arguments),
    Diagnose(commands::diagnose::Arguments),
    Discover(commands::discover::Arguments),
    Runs(commands::runs::Arguments),
    Fit(commands::fit::Arguments),
    Predict(commands::predict::Arguments),
    Compensate(commands::compensate::Arguments),
    Stiffness(commands::stiffness::Arguments),
    Transient(commands::transient::Arguments),
    Export(commands::export::Arguments),
    Design(commands::design::Arguments),
    Discriminate(commands::discriminate::Arguments),
    Power(commands::power::Arguments),
    Study(commands::study::Arguments),
    Regress(commands::regress::Arguments),
    Terms(commands::terms::Arguments),
    Challenge(commands::challenge::Arguments),
    Validate(commands::validate::Arguments),
    Workbench(commands::workbench::Arguments),
    Completions(commands::completions::Arguments),
}
