//! `hexbench validate regress`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_experiments::regress::baseline::Baseline;
use hexbench_experiments::regress::document::{Proof, document};
use hexbench_experiments::regress::gathered::gather;
use hexbench_experiments::regress::limit::Limit;
use hexbench_experiments::regress::limits::limits;
use hexbench_experiments::regress::planted;
use hexbench_experiments::regress::suite::Suite;
use hexbench_experiments::regress::trials::{Trials, run as run_suite};
use hexbench_experiments::regress::unchanged::{Kept, Unchanged, logged, machines};

use crate::commands::regress::COMMITTED;
use crate::failure::Failure;
use crate::output::{Progress, Screen};

/// Patches of the planted faults.
const PATCHES: &str = "data/regress/faults";

/// Say how far `regress` can be trusted: unchanged runs with fresh seeds must pass, planted faults must not
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Unchanged runs, each with a seed of its own
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    runs: u32,
    /// Seed of the first run; the others follow
    #[arg(long, value_name = "S", default_value_t = 1001)]
    seed: u64,
    /// Baseline to compare with
    #[arg(long, value_name = "FILE", default_value = COMMITTED)]
    baseline: PathBuf,
    /// Run the small suite
    #[arg(long)]
    quick: bool,
    /// Log of runs, one line each; runs in it are not repeated
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Folder with a result for each planted fault, as `scripts/planted_faults.sh` writes them
    #[arg(long, value_name = "DIR")]
    faults: Option<PathBuf>,
    /// Write the page docs/regress.md to FILE
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

/// Run, log, tell; write the page.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let suite = if arguments.quick { Suite::quick() } else { Suite::full() };
    let limits = limits(&suite);
    let baseline = Baseline::read_for(&arguments.baseline, &suite, &limits)?;
    let runs = unchanged(arguments, &suite, &limits, &baseline)?;
    if let Some(path) = &arguments.markdown {
        let planted = match &arguments.faults {
            Some(results) => planted::read((Path::new(PATCHES), results), &suite, &limits, &baseline)
                .map_err(|cause| unreadable(results, cause))?,
            None => Vec::new(),
        };
        let trials = run_suite(&suite, arguments.seed, &|| ());
        let counts: Vec<u64> = gather(&limits, &trials).iter().map(|g| g.sample.count()).collect();
        let proof = Proof {
            suite: &suite,
            limits: &limits,
            counts: &counts,
            baseline: &baseline,
            runs: &runs,
            planted: &planted,
        };
        screen.write_to(path, &document(&proof))?;
    }
    let failed: Vec<&Unchanged> = runs.iter().filter(|r| !r.worse.is_empty()).collect();
    let lines = failed.iter().map(|r| format!("seed {}: {}\n", r.seed, r.worse.join("; ")));
    screen.write(&format!(
        "{} of {} unchanged runs fail.\n{}",
        failed.len(),
        runs.len(),
        lines.collect::<String>()
    ))
}

/// Runs of the log and those that are missing in it, by seed.
fn unchanged(
    arguments: &Arguments,
    suite: &Suite,
    limits: &[Limit],
    baseline: &Baseline,
) -> Result<Vec<Unchanged>, Failure> {
    let known = match &arguments.log {
        Some(path) => logged(path, suite, limits).map_err(|cause| unreadable(path, cause))?,
        None => Vec::new(),
    };
    let machines = machines(suite);
    let progress = Progress::of(u64::from(arguments.runs), "runs");
    let mut runs = Vec::new();
    for seed in (0..u64::from(arguments.runs)).map(|k| arguments.seed.wrapping_add(k)) {
        let kept = match known.iter().find(|run| run.seed == seed) {
            Some(run) => run.clone(),
            None => fresh(arguments, suite, limits, &machines, seed)?,
        };
        runs.push(Unchanged::of(&kept, suite, limits, baseline));
        progress.advance(1);
    }
    progress.done();
    Ok(runs)
}

fn fresh(
    arguments: &Arguments,
    suite: &Suite,
    limits: &[Limit],
    machines: &Trials,
    seed: u64,
) -> Result<Kept, Failure> {
    let kept = Kept::run(suite, limits, machines, seed);
    if let Some(path) = &arguments.log {
        kept.append(path).map_err(|cause| Failure::Output { path: path.clone(), cause })?;
    }
    Ok(kept)
}

fn unreadable(path: &Path, cause: std::io::Error) -> Failure {
    Failure::Unreadable { path: path.to_owned(), cause }
}
