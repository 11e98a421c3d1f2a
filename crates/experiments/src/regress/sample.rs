//! What a limit remembers of a run: as much as a two-sample test needs, and no more.

use serde::{Deserialize, Serialize};

use super::limit::LimitTest;

/// Values of one limit, condensed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum CondensedValues {
    /// Campaigns in which something bad happened.
    Share {
        /// How often it happened.
        hits: u64,
        /// How often it could have.
        of: u64,
    },
    /// Logarithms of errors or counts.
    Size {
        /// How many.
        n: u64,
        /// Their sum.
        sum: f64,
        /// Sum of their squares.
        squares: f64,
    },
    /// Squared pulls, one mean per campaign.
    Spread {
        /// How many campaigns.
        n: u64,
        /// Their sum.
        sum: f64,
        /// Sum of their squares.
        squares: f64,
    },
    /// Values without chance, one for each machine; `null`: none was found.
    Exact {
        /// In the order of the machines.
        values: Vec<Option<f64>>,
    },
}

/// Largest mean squared pull that is taken at its word: one strange campaign must not decide a variance.
pub const LARGEST_SQUARE: f64 = 16.0;

impl CondensedValues {
    /// Condenses the values of a limit.
    pub fn of(test: LimitTest, values: &[f64]) -> Self {
        let n = values.len() as u64;
        let sums = |f: &dyn Fn(f64) -> f64| {
            values.iter().map(|&v| f(v)).fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x))
        };
        match test {
            LimitTest::Share => {
                Self::Share { hits: values.iter().filter(|v| **v > 0.5).count() as u64, of: n }
            }
            LimitTest::Size { range, .. } => {
                let (sum, squares) = sums(&|v| v.clamp(range[0], range[1]).ln());
                Self::Size { n, sum, squares }
            }
            LimitTest::Spread => {
                let (sum, squares) = sums(&|v| v.min(LARGEST_SQUARE));
                Self::Spread { n, sum, squares }
            }
            LimitTest::Exact | LimitTest::Bound => {
                Self::Exact { values: values.iter().map(|v| Some(*v).filter(|v| v.is_finite())).collect() }
            }
        }
    }

    /// How many values are behind it.
    pub fn count(&self) -> u64 {
        match self {
            Self::Share { of, .. } => *of,
            Self::Size { n, .. } | Self::Spread { n, .. } => *n,
            Self::Exact { values } => values.len() as u64,
        }
    }

    /// Mean and variance, as far as there are any; a share has the mean only.
    pub fn moments(&self) -> (f64, f64) {
        match *self {
            Self::Share { hits, of } => (hits as f64 / of as f64, f64::NAN),
            Self::Size { n, sum, squares } | Self::Spread { n, sum, squares } => {
                let (n, mean) = (n as f64, sum / n as f64);
                (mean, ((squares - n * mean * mean) / (n - 1.0)).max(0.0))
            }
            Self::Exact { ref values } => {
                (values.iter().map(|v| v.unwrap_or(f64::INFINITY)).fold(0.0, f64::max), f64::NAN)
            }
        }
    }

    /// Why it cannot be what it claims; `None` when it can.
    pub fn fault(&self) -> Option<String> {
        match *self {
            Self::Share { hits, of } if hits > of => Some(format!("{hits} hits of {of}")),
            Self::Size { n, sum, squares } | Self::Spread { n, sum, squares } => {
                // Cauchy and Schwarz, with room for rounding.
                let possible = sum.is_finite()
                    && squares.is_finite()
                    && sum * sum <= 1.000_001 * squares * n as f64 + 1e-9;
                (!possible).then(|| {
                    format!("sum {sum} and sum of squares {squares} of {n} values do not fit together")
                })
            }
            Self::Exact { ref values } if values.iter().flatten().any(|v| !v.is_finite() || *v < 0.0) => {
                Some("an error is negative or not finite".to_owned())
            }
            _ => None,
        }
    }

    /// True when both are of one kind.
    pub fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}
