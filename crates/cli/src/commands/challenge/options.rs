//! How a program under test is called: what `challenge run` and `gate` share.

use std::path::PathBuf;

use clap::{Args, value_parser};
use hexbench_experiments::challenge::run::{Entrant, Program, RunLimits};
use hexbench_experiments::harness::ExperimentPart;

use crate::failure::Failure;

/// Limits, and what answers are bound to.
#[derive(Debug, Args)]
pub(crate) struct RunOptions {
    /// Wall time limit of a case, s
    #[arg(long, value_name = "S", default_value_t = RunLimits::default().time_s)]
    time_limit: f64,
    /// Memory limit of a case, MB: for the address space of each process, and for all its processes together
    #[arg(long, value_name = "MB", default_value_t = RunLimits::default().memory_mb, value_parser = value_parser!(u64).range(16..=1_000_000))]
    memory_limit: u64,
    /// Output limit of a case, MB
    #[arg(long, value_name = "MB", default_value_t = RunLimits::default().output_mb, value_parser = value_parser!(u64).range(1..=100_000))]
    output_limit: u64,
    /// A file or folder that the program imports or reads: answers become invalid when it changes, as they do for the program and
    /// the files among its arguments
    #[arg(long, value_name = "PATH")]
    pub(crate) depends: Vec<PathBuf>,
}

/// A run shared among processes.
#[derive(Debug, Args)]
pub(crate) struct ShareOptions {
    /// Answer only the cases of one part: 2/8 is every eighth case from the second on
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<ExperimentPart>,
    /// Folders with the answers of the parts: all answers are merged, and nothing is run
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "shard")]
    pub(crate) parts: Vec<PathBuf>,
}

impl RunOptions {
    /// A program with these limits.
    pub(crate) fn entrant(&self, name: &str, line: &[String]) -> Result<Entrant, Failure> {
        let program = Program::find(line)?.with_depends(&self.depends)?;
        Ok(Entrant { name: name_of(name)?, program, limits: self.limits()? })
    }

    /// A function of the calling program, which no limit holds.
    pub(crate) fn inside(&self, name: &str, function: &Program) -> Result<Entrant, Failure> {
        let program = function.clone().with_depends(&self.depends)?;
        Ok(Entrant { name: name_of(name)?, program, limits: RunLimits::NONE })
    }

    fn limits(&self) -> Result<RunLimits, Failure> {
        const MOST_S: f64 = 1e6;
        let time_s = self.time_limit;
        if time_s > 0.0 && time_s <= MOST_S {
            return Ok(RunLimits { time_s, memory_mb: self.memory_limit, output_mb: self.output_limit });
        }
        Err(Failure::usage(
            format!("--time-limit {time_s}: a time is positive and at most {MOST_S} s"),
            "Omit it for one minute per case.",
        ))
    }
}

fn name_of(name: &str) -> Result<String, Failure> {
    const LONGEST: usize = 40;
    let fits = !name.is_empty() && name.chars().count() <= LONGEST;
    if fits && !name.contains(['|', '`']) && !name.contains(char::is_control) {
        return Ok(name.to_owned());
    }
    Err(Failure::usage(
        format!("--name {name:?}: a name has 1 to {LONGEST} characters, none of them | or `"),
        "Use a short name for the tables.",
    ))
}
