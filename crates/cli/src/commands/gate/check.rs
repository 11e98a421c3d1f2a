//! `hexbench gate check`.

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use hexbench_experiments::alarm::{BaselineFileError, LimitVerdict};
use hexbench_experiments::challenge::run::{Entrant, Program, RunLimits};
use hexbench_experiments::gate::cases::xml;
use hexbench_experiments::gate::comparison::compare;
use hexbench_experiments::gate::values::GateValues;
use hexbench_experiments::gate::work::{Checked, WorkFolder};
use hexbench_experiments::gate::{GateBaseline, GateEntrant, GateError, GateWork, page};

use super::{BASELINE, GateFunction, NAME, share};
use crate::commands::challenge::options::ShareOptions;
use crate::failure::Failure;
use crate::output::{ComparisonFiles, Progress, Screen, refuse_worse};

/// Run the current program over the cases of a baseline, and fail if its scores are significantly worse
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench gate check --junit gate.xml --markdown gate.md\n  \
    hexbench gate check -- ./build/solve --fast\n  \
    hexbench gate check --shard 2/8 --work part-2\n  \
    hexbench gate check --parts part-1 part-2 --junit gate.xml\n  \
    hexbench gate check --update --reason TEXT")]
pub(crate) struct Arguments {
    /// Baseline to compare with, or to replace with --update
    #[arg(long, value_name = "FILE", default_value = BASELINE)]
    baseline: PathBuf,
    /// The challenge with its sealed part, if the baseline was recorded on an existing challenge
    #[arg(long, value_name = "DIR")]
    challenge: Option<PathBuf>,
    /// Number of runs over all cases, if the runs of the baseline differ [default: as many as the baseline
    /// has]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=100))]
    repeats: Option<u16>,
    /// Number of cases run at the same time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// Folder in which to keep cases and answers for inspection [default: a temporary folder]; the program always
    /// runs again
    #[arg(long, value_name = "DIR")]
    work: Option<PathBuf>,
    #[command(flatten)]
    share: ShareOptions,
    #[command(flatten)]
    files: ComparisonFiles,
    /// Replace the baseline with the scores of the current program
    #[arg(long, requires = "reason")]
    update: bool,
    /// Why the baseline changes; stored in it
    #[arg(long, value_name = "TEXT", requires = "update")]
    reason: Option<String>,
    /// The program and its arguments [default: those of the baseline]
    #[arg(last = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

/// Check, or make a new baseline.
pub(crate) fn run(
    arguments: &Arguments,
    screen: &Screen,
    function: Option<&GateFunction<'_>>,
) -> Result<(), Failure> {
    let baseline = GateBaseline::read(&arguments.baseline)?;
    if arguments.reason.as_ref().is_some_and(|reason| reason.trim().is_empty()) {
        return Err(GateError::from(BaselineFileError::NoReason).into());
    }
    let (entrant, kept) = program(arguments, &baseline, function)?;
    let share = arguments.share.of_gate(arguments.work.as_deref())?;
    let work = WorkFolder::at(arguments.work.as_deref())?;
    let progress = Progress::of(0, "cases");
    let challenge = baseline.suite.again(arguments.challenge.as_deref(), work.path(), &progress)?;
    let at_work = GateWork::new(&challenge, &entrant, work.path(), usize::from(arguments.jobs), &progress)?;
    let at_work = at_work.by(function.map(|f| f.function)).with_share(share);
    let part = share::answered(&at_work);
    if let Some(reason) = &arguments.reason {
        let repeats = arguments.repeats.map_or(baseline.repeats, usize::from);
        let runs = at_work.runs(repeats)?;
        progress.done();
        if let Some(said) = part {
            return screen.tell(&said);
        }
        let new = GateBaseline::of((baseline.suite, &challenge), kept, &runs, (reason, baseline.history))?;
        new.write(&arguments.baseline)?;
        return screen.show(&page::recorded(&new));
    }
    let found = checked(arguments, &baseline, &at_work);
    progress.done();
    let found = found?;
    if let Some(said) = part {
        return screen.tell(&said);
    }
    let comparison = compare(&baseline, &kept, &found);
    arguments.files.write(screen, &page::page(&comparison), &comparison, || xml(&comparison))?;
    refuse_worse(comparison.of(LimitVerdict::Worse).map(|f| f.title.as_str()))
}

fn checked(
    arguments: &Arguments,
    baseline: &GateBaseline,
    at_work: &GateWork<'_>,
) -> Result<Checked, Failure> {
    if baseline.steady {
        return Ok(at_work.confirmed(&baseline.figures)?);
    }
    let mut runs = at_work.runs(arguments.repeats.map_or(baseline.repeats, usize::from))?;
    let values = GateValues::of(&runs);
    Ok(Checked { cases: runs.swap_remove(0), values, scattered: Vec::new() })
}

/// The program as it is now, and what a baseline keeps of it.
fn program(
    arguments: &Arguments,
    baseline: &GateBaseline,
    function: Option<&GateFunction<'_>>,
) -> Result<(Entrant, GateEntrant), Failure> {
    let recorded = &baseline.entrant;
    let typed = if arguments.program.is_empty() { &recorded.program } else { &arguments.program };
    let (line, found, limits) = match function.and_then(|function| function.program.as_ref()) {
        Some(program) => (program.line(), program.clone(), RunLimits::NONE),
        None if recorded.inside && arguments.program.is_empty() => {
            return Err(GateError::NeedsFunction(typed.join(" ")).into());
        }
        None => {
            let limits = if recorded.inside { RunLimits::default() } else { recorded.limits };
            (typed.as_slice(), Program::find(typed)?, limits)
        }
    };
    let depends: Vec<PathBuf> = recorded.depends.iter().map(|path| Path::new(path).to_owned()).collect();
    let program = found.with_depends(&depends)?;
    let entrant = Entrant { name: NAME.to_owned(), program, limits };
    let kept = GateEntrant::of(line, &recorded.depends, &entrant)?;
    Ok((entrant, kept))
}
