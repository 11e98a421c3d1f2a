//! `hexbench regress`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::alarm::{BaselineFileError, LimitVerdict, Update};
use hexbench_experiments::regress::baseline::{Baseline, BaselineError, made};
use hexbench_experiments::regress::cases::xml;
use hexbench_experiments::regress::comparison::compare;
use hexbench_experiments::regress::gathered::pool;
use hexbench_experiments::regress::limit::RegressLimit;
use hexbench_experiments::regress::limits::limits;
use hexbench_experiments::regress::suite::{BASELINE_RUNS, RegressSuite, SEED};
use hexbench_experiments::regress::summary::{self, headline};
use hexbench_experiments::regress::trials::SuiteRuns;

use crate::failure::Failure;
use crate::output::{ComparisonFiles, Screen, TrialFiles, refuse_worse};
use crate::shared::sole_experiment;

/// The baseline of the full suite.
pub(crate) const COMMITTED: &str = "data/regress/baseline.json";
/// The program that is compared.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Compare accuracy, calibration, diagnosis and effort with a committed baseline, and fail if any is significantly worse
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench regress --junit limits.xml\n  \
    hexbench regress --baseline baseline.json --json limits.json")]
pub(crate) struct Arguments {
    /// Baseline to compare with, or to write with --update
    #[arg(long, value_name = "FILE", default_value = COMMITTED)]
    baseline: PathBuf,
    /// Seed of all random numbers; another seed gives other campaigns of the same kind
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Run a small suite, which needs its own baseline
    #[arg(long)]
    quick: bool,
    /// Show every limit
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    files: ComparisonFiles,
    /// Replace the baseline with the figures of this program
    #[arg(long, requires = "reason", conflicts_with = "all")]
    update: bool,
    /// Why the baseline changes; stored in it
    #[arg(long, value_name = "TEXT", requires = "update")]
    reason: Option<String>,
    /// Number of runs for a new baseline, with consecutive seeds
    #[arg(long, value_name = "N", requires = "update", default_value_t = BASELINE_RUNS as u32,
          value_parser = clap::value_parser!(u32).range(1..=100))]
    runs: u32,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(|this: &Arguments| all_runs(this, &RegressSuite::chosen(this.quick)));

/// One run to compare, or those behind a baseline.
fn all_runs(arguments: &Arguments, suite: &RegressSuite) -> SuiteRuns {
    SuiteRuns::new(suite, arguments.seed, if arguments.update { arguments.runs as usize } else { 1 })
}

/// Compare with the baseline, or make a new one.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let suite = RegressSuite::chosen(arguments.quick);
    let limits = limits(&suite);
    match &arguments.reason {
        Some(reason) => update(arguments, &suite, &limits, reason, screen),
        None => check(arguments, &suite, &limits, screen),
    }
}

fn check(
    arguments: &Arguments,
    suite: &RegressSuite,
    limits: &[RegressLimit],
    screen: &Screen,
) -> Result<(), Failure> {
    let baseline = Baseline::read_for(&arguments.baseline, suite, limits)?;
    let run = all_runs(arguments, suite);
    let trials = run.of_each(arguments.kept.run(&run)?);
    let first = trials.first().ok_or_else(|| Failure::Check("no trials were run".into()))?;
    let comparison = compare(suite, limits, (first, arguments.seed), &baseline, VERSION);
    let page = summary::page(&comparison, arguments.all);
    arguments.files.write(screen, &page, &comparison, || xml(&comparison))?;
    refuse_worse(comparison.of(LimitVerdict::Worse).map(|f| f.title.as_str()))
}

fn update(
    arguments: &Arguments,
    suite: &RegressSuite,
    limits: &[RegressLimit],
    reason: &str,
    screen: &Screen,
) -> Result<(), Failure> {
    if reason.trim().is_empty() {
        return Err(BaselineError::from(BaselineFileError::NoReason).into());
    }
    let kept =
        if arguments.baseline.exists() { Baseline::read(&arguments.baseline)?.history } else { Vec::new() };
    Screen::make_folder_of(&arguments.baseline)?;
    let runs = arguments.runs as usize;
    let all = all_runs(arguments, suite);
    let trials = all.of_each(arguments.kept.run(&all)?);
    let update = Update::now(arguments.seed, runs, reason);
    let baseline = made(suite, limits, &pool(limits, &trials), update, kept)?;
    baseline.write(&arguments.baseline)?;
    let first = trials.first().map(|t| compare(suite, limits, (t, arguments.seed), &baseline, VERSION));
    let headline = first.map(|c| headline(&c)).unwrap_or_default();
    screen.tell(&format!(
        "{}: {} runs of suite {}/{}, update {}.\nIts first run beside all of them: {headline}\n",
        arguments.baseline.display(),
        baseline.runs,
        baseline.suite,
        baseline.suite_version,
        baseline.history.len(),
    ))
}
