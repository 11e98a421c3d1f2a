//! Stiffness errors by block: what trials on one machine with one plan have in common.

use hexbench_core::statistics::Welford;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Mean square errors of blocks of trials.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BlockSquares {
    done: Welford,
    open: OpenBlock,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct OpenBlock {
    number: u64,
    squares: f64,
    errors: u64,
}

impl BlockSquares {
    /// Takes in the errors of a trial of a block; blocks come in order.
    pub fn add(&mut self, block: u64, errors: impl IntoIterator<Item = f64>) {
        if block != self.open.number {
            *self = Self { done: self.closed(), open: OpenBlock { number: block, ..OpenBlock::default() } };
        }
        for error in errors {
            self.open.squares += error * error;
            self.open.errors += 1;
        }
    }

    /// Blocks of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { done: self.closed().and(other.closed()), open: OpenBlock::default() }
    }

    /// Mean squares of all blocks, the open one among them.
    fn closed(self) -> Welford {
        let mut all = self.done;
        if self.open.errors > 0 {
            all.add(self.open.squares / self.open.errors as f64);
        }
        all
    }

    /// Root of the mean square, and two-sided bounds that miss it with this chance: normal on the logarithm, blocks counted
    /// once. Bounds of fewer than two blocks are none (NaN).
    pub fn rms(self, error: f64) -> [f64; 3] {
        let all = self.closed();
        let (mean, blocks) = (all.mean(), all.count() as f64);
        if all.count() < 2 {
            return [mean.sqrt(), f64::NAN, f64::NAN];
        }
        let t = StudentsT::new(0.0, 1.0, blocks - 1.0).map_or(f64::NAN, |t| t.inverse_cdf(1.0 - 0.5 * error));
        let width = (0.5 * t * all.std() / (mean * blocks.sqrt())).exp();
        [mean.sqrt(), mean.sqrt() / width, mean.sqrt() * width]
    }
}
