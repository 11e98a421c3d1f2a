//! `hexbench challenge`: cases with a sealed truth for algorithms in any language; one file for each step.

mod answer;
mod lint;
mod make;
pub(crate) mod options;
mod run;
mod score;

use clap::{Args, Subcommand};

use crate::failure::Failure;
use crate::output::Screen;

/// Test algorithms in any language: make cases, run programs under limits, score their answers
#[derive(Debug, Args)]
#[command(
    arg_required_else_help = true,
    after_help = "Examples:\n  \
                        hexbench challenge make data/challenges/springs-and-effects.toml --out cases\n  \
                        hexbench challenge score cases answers\n  \
                        hexbench challenge lint out --case cases/case-001\n\n\
                        The README.md of every challenge and docs/guide/challenges.md describe what an entrant reads and writes."
)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    step: Step,
}

/// The steps.
#[derive(Debug, Subcommand)]
enum Step {
    Make(make::Arguments),
    Run(run::Arguments),
    Score(score::Arguments),
    Lint(lint::Arguments),
    Answer(answer::Arguments),
}

/// Do the step.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    match &arguments.step {
        Step::Make(arguments) => make::run(arguments, screen),
        Step::Run(arguments) => run::run(arguments, screen),
        Step::Score(arguments) => score::run(arguments, screen),
        Step::Lint(arguments) => lint::run(arguments, screen),
        Step::Answer(arguments) => answer::run(arguments),
    }
}

/// `--check` of a command that found so many cases without an answer.
fn refuse_unanswered(is_asked: bool, failed: usize) -> Result<(), Failure> {
    if is_asked && failed > 0 {
        return Err(Failure::Check(format!("{failed} cases have no answer")));
    }
    Ok(())
}
