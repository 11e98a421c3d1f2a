//! The history of a baseline.

use serde::{Deserialize, Serialize};

use super::date::today;

/// When, by which version and why a baseline was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Update {
    /// Year, month and day, UTC.
    pub date: String,
    /// Version of hexbench.
    pub hexbench: String,
    /// Seed of the first run.
    pub seed: u64,
    /// How many runs.
    pub runs: usize,
    /// Why.
    pub reason: String,
}

impl Update {
    /// An update of today by this version.
    pub fn now(seed: u64, runs: usize, reason: &str) -> Self {
        let hexbench = env!("CARGO_PKG_VERSION").to_owned();
        Self { date: today(), hexbench, seed, runs, reason: reason.trim().to_owned() }
    }

    /// The reason as part of a sentence.
    pub fn reason(&self) -> &str {
        self.reason.trim().trim_end_matches('.')
    }
}
