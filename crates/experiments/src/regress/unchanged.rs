//! Runs of the unchanged program with fresh seeds: how often do they fail?

use super::comparison::{LimitOutcome, RunComparison};
use crate::alarm::LimitVerdict;

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

impl From<&RunComparison> for Unchanged {
    fn from(comparison: &RunComparison) -> Self {
        let titles = |verdict| comparison.of(verdict).map(|f: &LimitOutcome| f.title.clone()).collect();
        let least = comparison.least_probable();
        Self {
            seed: comparison.seed,
            worse: titles(LimitVerdict::Worse),
            better: titles(LimitVerdict::Better),
            least: least.map_or(1.0, |l| l.0),
            least_of: least.map(|l| l.1.title.clone()).unwrap_or_default(),
        }
    }
}
