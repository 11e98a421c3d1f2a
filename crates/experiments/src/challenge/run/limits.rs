//! What a program may use.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Limits of one case, for the program and everything it starts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunLimits {
    /// Wall time, s.
    pub time_s: f64,
    /// Memory, MB (10^6 bytes): address space of each process; on Linux also what all its processes hold together.
    #[serde(rename = "memory_MB")]
    pub memory_mb: u64,
    /// Largest file and, together, all that is written, MB.
    #[serde(rename = "output_MB")]
    pub output_mb: u64,
}

impl Default for RunLimits {
    fn default() -> Self {
        Self { time_s: 60.0, memory_mb: 4096, output_mb: 64 }
    }
}

const MB: u64 = 1_000_000;

impl RunLimits {
    /// No limit is kept: how a function is run in the process that calls it.
    pub const NONE: Self = Self { time_s: 0.0, memory_mb: 0, output_mb: 0 };

    pub(super) fn time(&self) -> Duration {
        Duration::try_from_secs_f64(self.time_s).unwrap_or(Duration::MAX)
    }

    pub(super) fn memory_bytes(&self) -> u64 {
        self.memory_mb.saturating_mul(MB)
    }

    pub(super) fn output_bytes(&self) -> u64 {
        self.output_mb.saturating_mul(MB)
    }

    /// Arguments of `ulimit`: address space in KiB, size of a file in blocks of 512 bytes, CPU time in s. The last ends what
    /// outlives this program; what it watches ends by the wall clock.
    pub(super) fn of_the_system(&self) -> [String; 3] {
        const MARGIN_S: f64 = 10.0;
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let cpu = (self.time_s * cores as f64 + MARGIN_S).ceil();
        let [address, file] = [self.memory_bytes().div_ceil(1024), self.output_bytes().div_ceil(512)];
        [address.to_string(), file.to_string(), format!("{cpu:.0}")]
    }
}
