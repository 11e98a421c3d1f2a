//! `hexbench validate regress`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_experiments::regress::baseline::Baseline;
use hexbench_experiments::regress::comparison::compare;
use hexbench_experiments::regress::document::{Proof, page};
use hexbench_experiments::regress::gathered::pool;
use hexbench_experiments::regress::limits::limits;
use hexbench_experiments::regress::planted;
use hexbench_experiments::regress::suite::RegressSuite;
use hexbench_experiments::regress::trials::SuiteRuns;
use hexbench_experiments::regress::unchanged::Unchanged;
use hexbench_report::render::markdown;

use crate::commands::regress::COMMITTED;
use crate::failure::Failure;
use crate::output::{OutFile, Screen, TrialFiles};
use crate::shared::sole_experiment;

/// Patches of the planted faults.
const PATCHES: &str = "data/regress/faults";

/// Check how far `regress` can be trusted: unchanged runs with new seeds must pass, planted faults must fail
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate regress")]
pub(crate) struct Arguments {
    /// Number of unchanged runs, each with its own seed
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    runs: u32,
    /// Seed of the first run; the others have consecutive seeds
    #[arg(long, value_name = "S", default_value_t = 1001)]
    seed: u64,
    /// Baseline to compare with
    #[arg(long, value_name = "FILE", default_value = COMMITTED)]
    baseline: PathBuf,
    /// Run the small suite
    #[arg(long)]
    quick: bool,
    /// Folder with the results of the planted faults, written by `scripts/planted_faults.sh`
    #[arg(long, value_name = "DIR")]
    faults: Option<PathBuf>,
    /// Write the page docs/results/regress.md to FILE
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(|this: &Arguments| SuiteRuns::new(
    &RegressSuite::chosen(this.quick),
    this.seed,
    this.runs as usize
));

/// Run, tell; write the page.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let suite = RegressSuite::chosen(arguments.quick);
    let limits = limits(&suite);
    let baseline = Baseline::read_for(&arguments.baseline, &suite, &limits)?;
    let all = SuiteRuns::new(&suite, arguments.seed, arguments.runs as usize);
    let mut trials = all.of_each(arguments.kept.run(&all)?);
    if let [first, others @ ..] = &mut trials[..] {
        for run in others {
            run.machines.clone_from(&first.machines);
        }
    }
    let beside = |(trials, seed)| Unchanged::from(&compare(&suite, &limits, (trials, seed), &baseline, ""));
    let runs: Vec<Unchanged> = trials.iter().zip(all.seeds()).map(beside).collect();
    if let Some(path) = &arguments.markdown {
        let planted = match &arguments.faults {
            Some(results) => planted::read((Path::new(PATCHES), results), &suite, &limits, &baseline)
                .map_err(Failure::unreadable(results))?,
            None => Vec::new(),
        };
        let counts: Vec<u64> = pool(&limits, &trials[..1]).iter().map(|g| g.sample.count()).collect();
        let proof = Proof {
            suite: &suite,
            limits: &limits,
            counts: &counts,
            baseline: &baseline,
            runs: &runs,
            planted: &planted,
        };
        screen.write_to(path, &markdown(&page(&proof)))?;
    }
    let failed: Vec<&Unchanged> = runs.iter().filter(|r| !r.worse.is_empty()).collect();
    let lines = failed.iter().map(|r| format!("seed {}: {}\n", r.seed, r.worse.join("; ")));
    screen.tell(&format!(
        "{} of {} unchanged runs fail.\n{}",
        failed.len(),
        runs.len(),
        lines.collect::<String>()
    ))
}
