//! `hexbench challenge answer CASE OUT`: the bench's own entrants.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hexbench_model::results::answer::{Method, answer};

use crate::failure::Failure;

/// Answer one case as any entrant would: from its public files only
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench challenge answer cases/case-001 answer")]
pub(crate) struct Arguments {
    /// Folder of the case
    case: PathBuf,
    /// Folder for the answer
    out: PathBuf,
    /// Method of the answer
    #[arg(long, value_enum, default_value_t = Chosen::Hexbench)]
    method: Chosen,
}

/// Methods by name.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Chosen {
    /// The complete diagnosis: effects, averaged stiffnesses, predictions with uncertainty
    Hexbench,
    /// The paper's estimator: six springs by unweighted least squares, deflections only
    Paper,
}

/// Answer the case.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let method = match arguments.method {
        Chosen::Hexbench => Method::Hexbench,
        Chosen::Paper => Method::Paper,
    };
    Ok(answer(&arguments.case, &arguments.out, method)?)
}
