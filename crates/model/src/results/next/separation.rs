//! How well readings separate two Gaussian expectations.
//!
//! Where `a` has unit covariance and `b` a diagonal one, `lambda`, with means `delta` apart, everything is a sum over the
//! coordinates; any pair can be brought there. Under `a` the logarithm of the Bayes factor for `a` has the mean
//! `sum (1/lambda - 1 + delta^2/lambda + ln lambda) / 2`, the Kullback-Leibler divergence; under `b` the mean for `b` is
//! `sum (lambda - 1 + delta^2 - ln lambda) / 2`. Sources: Lindley 1956, Annals of Mathematical Statistics 27 (information of an
//! experiment); Box and Hill 1967, Technometrics 9 (discrimination among models).

use hexbench_core::streams::{Purpose, stream};
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};

/// Simulated outcomes behind a chance.
const OUTCOMES: u32 = 2000;
/// Seed of the simulated outcomes: the same pair gives the same chance.
const SEED: u64 = 1;

/// Separation of two explanations `a` and `b` by some readings.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Separation {
    /// Mean logarithm of the Bayes factor for the truth, when `a` is true and when `b` is, nats.
    pub log_bayes_factor: [f64; 2],
    /// Chance that the readings favor the truth, both being as probable beforehand.
    pub right: f64,
}

/// The pair in the coordinates of the module.
pub(super) struct Pair {
    delta: DVector<f64>,
    lambda: DVector<f64>,
}

impl Pair {
    /// From means and covariances; none without readings, or when the covariance of `a` is not positive definite.
    pub(super) fn new(a: (DVector<f64>, DMatrix<f64>), b: (DVector<f64>, DMatrix<f64>)) -> Option<Self> {
        if a.0.is_empty() {
            return None;
        }
        let root = a.1.cholesky()?.unpack();
        let half = root.solve_lower_triangular(&b.1)?;
        let whole = root.solve_lower_triangular(&half.transpose())?;
        if whole.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let eigen = (0.5 * (&whole + whole.transpose())).symmetric_eigen();
        let delta = eigen.eigenvectors.tr_mul(&root.solve_lower_triangular(&(b.0 - a.0))?);
        Some(Self { delta, lambda: eigen.eigenvalues.map(|l| l.max(f64::MIN_POSITIVE)) })
    }

    /// Mean logarithms of the Bayes factor for the truth, under `a` and under `b`.
    pub(super) fn log_bayes_factor(&self) -> [f64; 2] {
        let sum = |f: fn(f64, f64) -> f64| {
            0.5 * self.lambda.iter().zip(&self.delta).map(|(&l, &d)| f(l, d)).sum::<f64>()
        };
        [sum(|l, d| (1.0 + d * d) / l - 1.0 + l.ln()), sum(|l, d| l - 1.0 + d * d - l.ln())]
    }

    /// Everything about the pair.
    pub(super) fn separation(&self) -> Separation {
        Separation { log_bayes_factor: self.log_bayes_factor(), right: self.right() }
    }

    /// Share of simulated outcomes, half of them of either, whose Bayes factor favors the truth.
    fn right(&self) -> f64 {
        let mut rng = stream(SEED, Purpose::SeparationOutcomes, []);
        let mut hits = 0_u32;
        for outcome in 0..OUTCOMES {
            let from_a = outcome % 2 == 0;
            let mut twice = 0.0;
            for (&l, &d) in self.lambda.iter().zip(&self.delta) {
                let z: f64 = StandardNormal.sample(&mut rng);
                let y = if from_a { z } else { d + l.sqrt() * z };
                twice += (y - d).powi(2) / l - y * y + l.ln();
            }
            hits += u32::from((twice > 0.0) == from_a);
        }
        f64::from(hits) / f64::from(OUTCOMES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOSE: f64 = 1e-12;
    /// Four standard deviations of a share of the simulated outcomes.
    const CHANCE: f64 = 0.045;

    fn scalar(mean: f64, variance: f64) -> (DVector<f64>, DMatrix<f64>) {
        (DVector::from_element(1, mean), DMatrix::from_element(1, 1, variance))
    }

    #[test]
    fn two_means_apart_have_half_the_squared_distance() {
        let s = Pair::new(scalar(1.0, 4.0), scalar(5.0, 4.0)).unwrap().separation();
        assert!(s.log_bayes_factor.iter().all(|l| (l - 2.0).abs() < CLOSE), "{:?}", s.log_bayes_factor);
        // Normal distribution at half the distance.
        assert!((s.right - 0.8413).abs() < CHANCE, "{}", s.right);
    }

    /// Kullback-Leibler divergence of N(0, 1) and N(0, 4): (1/4 - 1 + ln 4) / 2, and (4 - 1 - ln 4) / 2 the other way round.
    #[test]
    fn a_wide_and_a_narrow_expectation_separate_unequally() {
        let [narrow, wide] = Pair::new(scalar(0.0, 1.0), scalar(0.0, 4.0)).unwrap().log_bayes_factor();
        let ln4 = 4.0_f64.ln();
        assert!((narrow - 0.5 * (ln4 - 0.75)).abs() < CLOSE && (wide - 0.5 * (3.0 - ln4)).abs() < CLOSE);
    }

    #[test]
    fn no_reading_and_no_number_separate_nothing_that_could_be_told() {
        let none = || (DVector::zeros(0), DMatrix::zeros(0, 0));
        assert!(Pair::new(none(), none()).is_none());
        assert!(Pair::new(scalar(0.0, 1.0), scalar(0.0, f64::NAN)).is_none());
    }

    #[test]
    fn what_both_expect_alike_separates_nothing() {
        let s = Pair::new(scalar(1.0, 2.0), scalar(1.0, 2.0)).unwrap().separation();
        assert!(s.log_bayes_factor.iter().all(|l| l.abs() < CLOSE));
    }

    #[test]
    fn a_change_of_coordinates_changes_nothing() {
        let t = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, -0.5, 3.0]);
        let (ma, mb) = (DVector::from_vec(vec![0.0, 1.0]), DVector::from_vec(vec![2.0, 0.5]));
        let va = DMatrix::from_row_slice(2, 2, &[2.0, 0.3, 0.3, 1.0]);
        let vb = DMatrix::from_row_slice(2, 2, &[1.0, -0.2, -0.2, 3.0]);
        let before =
            Pair::new((ma.clone(), va.clone()), (mb.clone(), vb.clone())).unwrap().log_bayes_factor();
        let moved = |m: DVector<f64>, v: DMatrix<f64>| (&t * m, &t * v * t.transpose());
        let after = Pair::new(moved(ma, va), moved(mb, vb)).unwrap().log_bayes_factor();
        assert!((0..2).all(|k| (before[k] / after[k] - 1.0).abs() < CLOSE), "{before:?} {after:?}");
    }
}
