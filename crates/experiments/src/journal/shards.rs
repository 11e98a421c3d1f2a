//! How trials are divided.

use std::ops::Range;

/// Consecutive trials in shards of equal size: a shard is computed and kept as one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shards {
    /// All trials.
    pub trials: u64,
    /// Trials of a shard, at least one.
    pub size: u64,
}

impl Shards {
    /// Number of shards.
    pub fn count(self) -> u64 {
        self.trials.div_ceil(self.size)
    }

    /// Trials of a shard.
    pub fn trials_of(self, shard: u64) -> Range<u64> {
        shard * self.size..((shard + 1) * self.size).min(self.trials)
    }

    /// Trials of several shards.
    pub fn trials_in(self, shards: &[u64]) -> u64 {
        shards.iter().map(|&n| self.trials_of(n)).map(|t| t.end - t.start).sum()
    }
}
