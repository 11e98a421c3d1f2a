//! Runs of the unchanged program with fresh seeds: how often do they fail?

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::baseline::Baseline;
use super::comparison::{Comparison, Finding, of_samples};
use super::gathered::{Gathered, gather};
use super::limit::Limit;
use super::rule::Verdict;
use super::sample::Sample;
use super::suite::Suite;
use super::trials::{Trials, run};

/// What is kept of one run: it can be compared with any baseline of its suite.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kept {
    /// Name of the suite.
    pub suite: String,
    /// Its version.
    pub version: u32,
    /// Seed of the run.
    pub seed: u64,
    /// In the order of the limits.
    pub samples: Vec<Sample>,
}

impl Kept {
    /// Runs a suite; campaigns without noise, which are the same in every run, are taken from `machines`.
    pub fn run(suite: &Suite, limits: &[Limit], machines: &Trials, seed: u64) -> Self {
        let noisy = run(&suite.without_machines(), seed, &|| ());
        let trials = Trials { machines: machines.machines.clone(), ..noisy };
        let samples = gather(limits, &trials).into_iter().map(|g| g.sample).collect();
        Self { suite: suite.name.to_owned(), version: suite.version, seed, samples }
    }

    /// Adds a line to a log.
    ///
    /// # Errors
    /// Those of the file.
    pub fn append(&self, path: &Path) -> io::Result<()> {
        let line = serde_json::to_string(self)? + "\n";
        OpenOptions::new().create(true).append(true).open(path)?.write_all(line.as_bytes())
    }

    fn is_of(&self, suite: &Suite, limits: &[Limit]) -> bool {
        (self.suite.as_str(), self.version, self.samples.len()) == (suite.name, suite.version, limits.len())
    }
}

/// Campaigns of a suite without noise.
pub fn machines(suite: &Suite) -> Trials {
    run(&Suite { fits: 0, portions: Vec::new(), ..suite.clone() }, 0, &|| ())
}

/// Runs of a log that are of this suite; a last line that was cut off when a study was stopped is passed over.
///
/// # Errors
/// Those of the file; no log is no error.
pub fn logged(path: &Path, suite: &Suite, limits: &[Limit]) -> io::Result<Vec<Kept>> {
    let text = match std::fs::read_to_string(path) {
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        text => text?,
    };
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Kept>(line).ok());
    Ok(lines.filter(|run| run.is_of(suite, limits)).collect())
}

/// What became of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Unchanged {
    /// Its seed.
    pub seed: u64,
    /// Limits that failed.
    pub worse: Vec<String>,
    /// Limits better than chance explains.
    pub better: Vec<String>,
    /// Smallest probability among all limits.
    pub least: f64,
    /// Its limit.
    pub least_of: String,
}

impl Unchanged {
    /// A run beside a baseline.
    pub fn of(kept: &Kept, suite: &Suite, limits: &[Limit], baseline: &Baseline) -> Self {
        let gathered: Vec<Gathered> = kept
            .samples
            .iter()
            .map(|sample| Gathered { sample: sample.clone(), fingerprint: String::new() })
            .collect();
        Self::from(&of_samples(suite, limits, (&gathered, kept.seed), baseline, ""))
    }
}

impl From<&Comparison> for Unchanged {
    fn from(comparison: &Comparison) -> Self {
        let titles = |verdict| comparison.of(verdict).map(|f: &Finding| f.title.clone()).collect();
        let least = comparison.least_probable();
        Self {
            seed: comparison.seed,
            worse: titles(Verdict::Worse),
            better: titles(Verdict::Better),
            least: least.map_or(1.0, |l| l.0),
            least_of: least.map(|l| l.1.title.clone()).unwrap_or_default(),
        }
    }
}
