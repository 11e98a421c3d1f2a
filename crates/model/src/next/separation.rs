//! How well readings separate two Gaussian expectations.
//!
//! Where `a` has unit covariance and `b` a diagonal one, `lambda`, with means `delta` apart, everything is a sum over the
//! coordinates; any pair can be brought there. Under `a` the logarithm of the Bayes factor for `a` has the mean
//! `sum (1/lambda - 1 + delta^2/lambda + ln lambda) / 2`, the Kullback-Leibler divergence; under `b` the mean for `b` is
//! `sum (lambda - 1 + delta^2 - ln lambda) / 2`. Sources: Lindley 1956, Annals of Mathematical Statistics 27 (information of an
//! experiment); Box and Hill 1967, Technometrics 9 (discrimination among models).

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Simulated outcomes behind a chance.
const OUTCOMES: u32 = 2000;
/// Seed of the simulated outcomes: the same pair gives the same chance.
const SEED: u64 = 1;

/// Separation of two explanations `a` and `b` by some readings.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Separation {
    /// Mean logarithm of the Bayes factor for the truth, when `a` is true and when `b` is, nats.
    pub log_bayes_factor: [f64; 2],
    /// Chance that the readings favour the truth, both being as probable beforehand.
    pub right: f64,
}

/// The pair in the coordinates of the module.
pub(super) struct Pair {
    delta: DVector<f64>,
    lambda: DVector<f64>,
}

impl Pair {
    /// From means and covariances; none when the covariance of `a` is not positive definite.
    pub(super) fn new(a: (DVector<f64>, DMatrix<f64>), b: (DVector<f64>, DMatrix<f64>)) -> Option<Self> {
        let root = a.1.cholesky()?.unpack();
        let half = root.solve_lower_triangular(&b.1)?;
        let whole = root.solve_lower_triangular(&half.transpose())?;
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

    /// Share of simulated outcomes, half of them of either, whose Bayes factor favours the truth.
    fn right(&self) -> f64 {
        let mut rng = Pcg64::seed_from_u64(SEED);
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
