//! Proper scores of numbers that are stated with an uncertainty.
//!
//! With `y` the truth, `m` what is stated, `s` its standard uncertainty and `z = (y - m) / s`, of a normal law:
//!
//! ```text
//! CRPS     = s (z (2 Phi(z) - 1) + 2 phi(z) - 1 / sqrt(pi))       |y - m| without an uncertainty
//! interval = 2 k s + (2 / 0.05) max(0, |y - m| - k s),  k = 1.96   the 95 % interval: its length, and 40 times what lies outside
//! ```
//!
//! Both are in the unit of the number, and 0 is perfect. In expectation nobody does better than by stating what he believes: wide
//! intervals hold everything and pay for their length. Source: Gneiting and Raftery 2007, Journal of the American Statistical
//! Association 102, sections 4.2 and 6.2.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use hexbench_core::statistics::COVERAGE_FACTOR;
use serde::Serialize;
use statrs::function::erf::erf;

/// Share of the truths that the interval leaves outside.
const OUTSIDE: f64 = 0.05;

/// Scores of numbers with an uncertainty, in the unit of their errors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProperScore {
    /// Continuous ranked probability score; the absolute error where no uncertainty is stated.
    pub crps: f64,
    /// Interval score of the stated 95 % interval.
    pub interval: Option<f64>,
}

impl ProperScore {
    /// Scores one number by its error and its stated standard uncertainty.
    pub(super) fn of(error: f64, std: Option<f64>) -> Self {
        Self {
            crps: std.map_or(error.abs(), |std| crps(error, std)),
            interval: std.map(|s| interval(error, s)),
        }
    }

    /// Mean over several numbers; of the interval score where all have one.
    pub(super) fn mean(all: &[Self]) -> Option<Self> {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let crps: Vec<f64> = all.iter().map(|s| s.crps).collect();
        let intervals: Option<Vec<f64>> = all.iter().map(|s| s.interval).collect();
        (!all.is_empty()).then(|| Self { crps: mean(&crps), interval: intervals.map(|i| mean(&i)) })
    }

    /// The same in another unit.
    pub(super) fn times(self, factor: f64) -> Self {
        Self { crps: self.crps * factor, interval: self.interval.map(|i| i * factor) }
    }
}

fn crps(error: f64, std: f64) -> f64 {
    let z = error / std;
    let density = (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
    std * (z * erf(z * FRAC_1_SQRT_2) + 2.0 * density - PI.sqrt().recip())
}

fn interval(error: f64, std: f64) -> f64 {
    let half = COVERAGE_FACTOR * std;
    2.0 * half + 2.0 / OUTSIDE * (error.abs() - half).max(0.0)
}

#[cfg(test)]
mod tests {
    use hexbench_core::streams::{Purpose, stream};
    use rand::RngExt;
    use rand_distr::StandardNormal;

    use super::*;

    #[test]
    fn the_closed_form_is_the_integral_it_stands_for() {
        // CRPS is the integral of (F(x) - [x >= y])^2; midpoints, as far as the law reaches.
        for (error, std) in [(0.0, 1.0), (0.7, 1.0), (-2.5, 0.4), (3.0, 2.0)] {
            let (steps, reach) = (400_000, 12.0 * std + 2.0 * f64::abs(error));
            let width = 2.0 * reach / f64::from(steps);
            let square = |k: i32| {
                let x = -reach + (f64::from(k) + 0.5) * width;
                let law = 0.5 * (1.0 + erf((x + error) / std * FRAC_1_SQRT_2));
                (law - if x >= 0.0 { 1.0 } else { 0.0 }).powi(2) * width
            };
            let (sum, found) = ((0..steps).map(square).sum::<f64>(), crps(error, std));
            assert!((sum - found).abs() < 1e-4 * std, "{error} +- {std}: {found}, the integral is {sum}");
        }
        // As the uncertainty goes to nothing, what is left is the error.
        assert!(
            (crps(0.3, 1e-9) - 0.3).abs() < 1e-8 && (ProperScore::of(-0.3, None).crps - 0.3).abs() < 1e-15
        );
    }

    #[test]
    fn neither_huge_nor_tiny_uncertainties_beat_the_honest_one() {
        const TRUE_STD: f64 = 0.5;
        let mut rng = stream(3, Purpose::Test, []);
        let errors: Vec<f64> = (0..20_000).map(|_| TRUE_STD * rng.sample::<f64, _>(StandardNormal)).collect();
        let mean = |stated: f64| {
            let all: Vec<_> = errors.iter().map(|e| ProperScore::of(*e, Some(stated))).collect();
            ProperScore::mean(&all).unwrap()
        };
        let honest = mean(TRUE_STD);
        for stated in [1e-3, 0.25, 0.4, 0.65, 1.0, 1e3] {
            let other = mean(stated);
            assert!(honest.crps < other.crps && honest.interval < other.interval, "{stated}: {other:?}");
        }
    }
}
