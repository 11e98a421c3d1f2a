//! How often noise alone gives the paper's errors, over many repetitions of its experiment.

use hexbench_core::statistics::quantile;
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::paper::regressor;
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::bench::{PaperMachine, sigma};
use super::error::PaperError;
use super::identify::{pooled, rms};

/// Errors of prediction over repetitions with springs alone, by the paper's estimator.
#[derive(Debug, Clone, PartialEq)]
pub struct Repetitions {
    /// Number of repetitions.
    pub count: usize,
    /// Median of the error of each coordinate, um and urad.
    pub median: [f64; 6],
    /// Error of each coordinate that one repetition in twenty exceeds, um and urad.
    pub upper: [f64; 6],
    /// Share of repetitions whose translation errors together are at least the given ones.
    pub share_as_large: f64,
}

/// Repeats identification and validation with fresh noise; `error` is what the share is counted against.
///
/// # Errors
/// [`PaperError::Model`] when the plan does not determine the springs.
pub fn repetitions(
    bench: &PaperMachine,
    data: [&Dataset; 2],
    count: usize,
    error: &[f64; 6],
    seed: u64,
) -> Result<Repetitions, PaperError> {
    let [fitted, held_out] = [regressor(&bench.hexapod, data[0])?, regressor(&bench.hexapod, data[1])?];
    let inverse = fitted.pseudo_inverse(0.0).map_err(|_| ModelError::NoLoad)?;
    let gain = &held_out * inverse;
    let mut rng = stream(seed, Purpose::PaperRepetitions, []);
    let errors: Vec<[f64; 6]> = (0..count).map(|_| one(&gain, &mut rng)).collect();
    let limit = pooled(error, 0);
    let large = errors.iter().filter(|e| pooled(e, 0) >= limit).count();
    Ok(Repetitions {
        count,
        median: quantiles(&errors, 0.5),
        upper: quantiles(&errors, 0.95),
        share_as_large: large as f64 / count.max(1) as f64,
    })
}

fn one(gain: &DMatrix<f64>, rng: &mut Pcg64) -> [f64; 6] {
    let fitted = noise(gain.ncols(), rng);
    let held_out = noise(gain.nrows(), rng) - gain * fitted;
    rms((0..gain.nrows() / 6).map(|i| Vector6::from_fn(|k, _| held_out[6 * i + k])))
}

fn noise(rows: usize, rng: &mut Pcg64) -> DVector<f64> {
    let sigma = sigma();
    DVector::from_fn(rows, |i, _| {
        let unit: f64 = StandardNormal.sample(rng);
        unit * sigma[i % 6]
    })
}

/// Quantile of each coordinate.
fn quantiles(errors: &[[f64; 6]], share: f64) -> [f64; 6] {
    std::array::from_fn(|k| quantile(errors.iter().map(|e| e[k]), share).unwrap_or(0.0))
}
