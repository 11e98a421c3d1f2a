//! `hexbench gate`: accuracy regression of a user's program; one file for each step.

mod check;
mod record;
mod share;

use clap::{Args, Subcommand};
use hexbench_experiments::challenge::run::{InsideFunction, Program};

use crate::failure::Failure;
use crate::output::Screen;

/// Where the baseline is unless it is named.
const BASELINE: &str = "hexbench-gate.json";
/// Name of the program in what is kept of a work.
const NAME: &str = "program";

/// Guard the accuracy of your own algorithm: record its scores once, then fail if a change makes them
/// significantly worse
#[derive(Debug, Args)]
#[command(
    arg_required_else_help = true,
    after_help = "Examples:\n  \
                  hexbench gate record springs-and-effects -- python3 solve.py\n  \
                  hexbench gate check --junit gate.xml\n  \
                  hexbench gate check --update --reason TEXT\n\n\
                  docs/guide/challenges.md describes what a program reads and writes."
)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    step: Step,
}

/// The steps.
#[derive(Debug, Subcommand)]
enum Step {
    Record(record::Arguments),
    Check(check::Arguments),
}

/// A function of the calling program in place of a program.
pub struct GateFunction<'a> {
    /// Its name and what it is made of; none where it runs the program of the command line elsewhere.
    pub program: Option<Program>,
    /// The function.
    pub function: InsideFunction<'a>,
}

/// Do the step.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    run_by(arguments, screen, None)
}

/// Do the step, by a function where there is one.
pub(crate) fn run_by(
    arguments: &Arguments,
    screen: &Screen,
    function: Option<&GateFunction<'_>>,
) -> Result<(), Failure> {
    match &arguments.step {
        Step::Record(arguments) => record::run(arguments, screen, function),
        Step::Check(arguments) => check::run(arguments, screen, function),
    }
}
