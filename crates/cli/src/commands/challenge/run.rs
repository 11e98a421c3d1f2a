//! `hexbench challenge run DIR -o ANSWERS --name NAME -- PROGRAM ARGS...`.

use std::path::PathBuf;

use clap::{Args, value_parser};
use hexbench_experiments::challenge::Challenge;
use hexbench_experiments::challenge::run::{Entrant, Manner, Program, RunLimits, Summary, run as run_cases};

use crate::failure::Failure;
use crate::output::{Progress, Screen};

/// Run a program over the cases, each in a fresh folder and under limits of time, memory and output
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
                        hexbench challenge run cases --out answers --name mine -- python3 solve.py\n\n\
                        The program is called with the case folder and the folder for its answer behind its own arguments. \
                        Given again, the same command goes on where it was stopped. The limits hold on Linux; on other \
                        Unix systems memory is limited for each process alone, as far as the system does that.")]
pub(crate) struct Arguments {
    /// The challenge
    challenge: PathBuf,
    /// Folder for the answers
    #[arg(short = 'o', long, value_name = "ANSWERS")]
    out: PathBuf,
    /// Name in the tables
    #[arg(long)]
    name: String,
    /// Most wall time of a case, s
    #[arg(long, value_name = "S", default_value_t = RunLimits::default().time_s)]
    time_limit: f64,
    /// Most memory of a case, MB: address space of a process, and all that its processes hold together
    #[arg(long, value_name = "MB", default_value_t = RunLimits::default().memory_mb, value_parser = value_parser!(u64).range(16..=1_000_000))]
    memory_limit: u64,
    /// Most bytes a case may write, MB
    #[arg(long, value_name = "MB", default_value_t = RunLimits::default().output_mb, value_parser = value_parser!(u64).range(1..=100_000))]
    output_limit: u64,
    /// Cases at once; times are only comparable with one
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// Answer all cases again
    #[arg(long)]
    again: bool,
    /// A file or folder that the program imports or reads: answers are bound to what it holds, as they are to the program and its
    /// arguments that are files
    #[arg(long, value_name = "PATH")]
    depends: Vec<PathBuf>,
    /// The program and its own arguments
    #[arg(last = true, required = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

/// Run what is missing, tell what failed.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let challenge = Challenge::open(&arguments.challenge)?;
    let entrant = Entrant {
        name: name(&arguments.name)?,
        program: Program::find(&arguments.program)?.with_depends(&arguments.depends)?,
        limits: limits(arguments)?,
    };
    let manner = Manner { jobs: usize::from(arguments.jobs), again: arguments.again };
    let progress = Progress::of(0, "cases");
    let summary = run_cases(&challenge, &entrant, &arguments.out, manner, &progress);
    progress.done();
    screen.tell(&told(&summary?, &entrant.name))
}

fn name(name: &str) -> Result<String, Failure> {
    const LONGEST: usize = 40;
    let fits = !name.is_empty() && name.chars().count() <= LONGEST;
    if fits && !name.contains(['|', '`']) && !name.contains(char::is_control) {
        return Ok(name.to_owned());
    }
    Err(Failure::Usage {
        message: format!("--name {name:?}: a name has 1 to {LONGEST} characters, none of them | or `"),
        next: "Give a short name for the tables.".into(),
    })
}

fn limits(arguments: &Arguments) -> Result<RunLimits, Failure> {
    const MOST_S: f64 = 1e6;
    let time_s = arguments.time_limit;
    if time_s > 0.0 && time_s <= MOST_S {
        return Ok(RunLimits {
            time_s,
            memory_mb: arguments.memory_limit,
            output_mb: arguments.output_limit,
        });
    }
    Err(Failure::Usage {
        message: format!("--time-limit {time_s}: a time is positive and at most {MOST_S} s"),
        next: "Leave it out for one minute a case.".into(),
    })
}

fn told(summary: &Summary, name: &str) -> String {
    let failed: Vec<_> = summary.fresh.iter().filter_map(|r| Some((&r.case, r.failure.as_ref()?))).collect();
    let head = format!(
        "{name}: {} cases answered, {} failed, {} answered before.\n",
        summary.fresh.len() - failed.len(),
        failed.len(),
        summary.known
    );
    let lines = failed.into_iter().map(|(case, why)| format!("  {case}: {why}\n"));
    std::iter::once(head).chain(lines).collect()
}
