//! What a limit can say, and the probabilities behind it.

use serde::{Deserialize, Serialize};

/// Probability that a run of an unchanged program fails.
pub const FALSE_ALARM: f64 = 1e-3;
/// Probability with which the change is noticed that a limit states.
pub const POWER: f64 = 0.9;

/// How a limit compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LimitVerdict {
    /// As the baseline, as far as chance can tell.
    Same,
    /// Better than chance explains.
    Better,
    /// Worse than chance explains.
    Worse,
}

impl LimitVerdict {
    /// The verdict of what is worse, else of what is better.
    pub fn of(worse: bool, better: bool) -> Self {
        match (worse, better) {
            (true, _) => Self::Worse,
            (_, true) => Self::Better,
            _ => Self::Same,
        }
    }
}

/// Share of [`FALSE_ALARM`] that each of so many limits has in which chance takes part (Bonferroni).
pub fn share_of_level(limits: usize) -> f64 {
    FALSE_ALARM / limits.max(1) as f64
}

/// A probability with one digit, small ones as a power of ten.
pub fn probability(p: f64) -> String {
    if p >= 0.01 { format!("{p:.2}") } else { format!("{p:.0e}") }
}

/// The smallest argument for which a statement is true that is true for all beyond, to a few digits.
pub(crate) fn bisected(low: f64, high: f64, is_true: impl Fn(f64) -> bool) -> f64 {
    const STEPS: usize = 40;
    let halved = |(low, high): (f64, f64), _| {
        let middle = f64::midpoint(low, high);
        if is_true(middle) { (low, middle) } else { (middle, high) }
    };
    (0..STEPS).fold((low, high), halved).1
}
