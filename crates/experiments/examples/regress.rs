//! The full suite beside a baseline: what `hexbench regress --baseline BASELINE --json RESULT` does, without the command around it,
//! so that `scripts/planted_faults.sh` builds little for each fault.
//!
//! `cargo run --release -p hexbench-experiments --example regress -- BASELINE RESULT`

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use hexbench_core::files::atomic_write;
use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::regress::baseline::Baseline;
use hexbench_experiments::regress::comparison::compare;
use hexbench_experiments::regress::limits::limits;
use hexbench_experiments::regress::suite::{RegressSuite, SEED};
use hexbench_experiments::regress::trials::SuiteRuns;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, baseline, result] = arguments.as_slice() else {
        return Err("usage: regress BASELINE RESULT".into());
    };
    let suite = RegressSuite::full();
    let limits = limits(&suite);
    let baseline = Baseline::read_for(Path::new(baseline), &suite, &limits)?;
    let run = SuiteRuns::new(&suite, SEED, 1);
    let trials = run.of_each(harness::run(&run, None, &Silent)?);
    let comparison = compare(&suite, &limits, (&trials[0], SEED), &baseline, env!("CARGO_PKG_VERSION"));
    let text = serde_json::to_string_pretty(&comparison)? + "\n";
    atomic_write(Path::new(result), |out| out.write_all(text.as_bytes()))?;
    Ok(if comparison.fails() { ExitCode::from(1) } else { ExitCode::SUCCESS })
}
