//! The history of a baseline.

use std::time::{SystemTime, UNIX_EPOCH};

use hexbench_core::calendar::civil;
use serde::{Deserialize, Serialize};

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

/// Today's date as `2026-11-21`, UTC.
fn today() -> String {
    const DAY_S: u64 = 86_400;
    let since = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let [year, month, day] = civil((since / DAY_S).cast_signed());
    format!("{year:04}-{month:02}-{day:02}")
}
