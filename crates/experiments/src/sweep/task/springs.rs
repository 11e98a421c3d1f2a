//! Six stiffnesses, fitted and compared with the truth.
//!
//! The estimator is linear in the noise: once for a block it is fitted to the readings without noise, which gives `c*` (with
//! whatever bias a hidden effect or the linearization of the model brings), and its gain `G` there. A trial is then
//!
//! ```text
//! c = c* + G z          z: noise of the averaged readings in standard deviations
//! ```
//!
//! For the paper's estimator this is exact. For generalised least squares it leaves out how the noise moves the point of
//! linearization: of order noise / (k leg length) of a standard error. The mean of n readings is drawn at once, with its own
//! standard deviation. The error of a prediction, linear in `c` too, is a quadratic form: trials cost the same for any number of
//! held-out readings.

use hexbench_core::statistics::COVERAGE_FACTOR;
use hexbench_core::{Matrix6, Vector6};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::paper;
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::blocks;
use crate::sweep::axes::SweepEstimator;
use crate::sweep::bench::BlockSetup;
use crate::sweep::columns::Status;
use crate::sweep::draw::{SweepPurpose, generator};
use crate::sweep::ideal::Ideal;
use crate::sweep::runner::Runner;
use crate::sweep::shard::{Shard, Value};

/// A compliance less sure than this share of itself may be zero: it has no stiffness to report.
const SURE: f64 = 0.5;

/// Runs the trials of a shard.
pub fn run(runner: &Runner, shard: &mut Shard) {
    let seed = runner.study().seed;
    blocks(
        runner,
        shard,
        |bench, cell| Ok((Prepared::of(&bench, cell.estimator())?, bench.index_values())),
        |(prepared, indices), cell, trial, shard| {
            let found = prepared.trial(&mut generator(seed, SweepPurpose::Noise, cell.index, trial));
            match found {
                Some(found) => shard.push(found.values().chain(indices.iter().copied())),
                None => shard.push_failed(Status::NotDetermined),
            }
        },
    );
}

/// Everything about a block that its trials need.
#[derive(Debug, Clone)]
pub struct Prepared {
    true_stiffness: Vector6,
    center: Vector6,
    gain: Vec<Vector6>,
    std: Vector6,
    translations: Quadratic,
    rotations: Quadratic,
    /// Of the numbers that are read.
    readings: Quadratic,
    sigma: [f64; 2],
}

/// What a trial finds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringsResult {
    /// Estimated over true stiffness minus one.
    pub errors: [f64; 6],
    /// Legs whose 95 % interval holds the truth.
    pub covered: u8,
    /// Root mean square error of a prediction: translations (m), rotations (rad), numbers that are read in standard deviations.
    pub holdout: [f64; 3],
}

impl SpringsResult {
    fn values(&self) -> impl Iterator<Item = Value> {
        let [t, r, readings] = self.holdout;
        let holdout = [t * 1e6, r * 1e6, readings];
        let errors = self.errors.map(|e| Value::Number(100.0 * e));
        errors.into_iter().chain([Value::Code(self.covered)]).chain(holdout.map(Value::Number))
    }
}

impl Prepared {
    /// Fits the readings without noise.
    ///
    /// # Errors
    /// [`Status::NotDetermined`], [`Status::NoFit`].
    pub fn of(bench: &BlockSetup, estimator: SweepEstimator) -> Result<Self, Status> {
        let data = bench.training.dataset("measurements", None);
        let campaign = Campaign::new(&bench.hexapod, &data).map_err(|_| Status::NoFit)?;
        let (center, gain) = match estimator {
            SweepEstimator::Gls => weighted(&campaign)?,
            SweepEstimator::Paper => unweighted(&campaign)?,
        };
        let covariance = &gain * gain.transpose();
        let sigma = [bench.noise.sigma_translation, bench.noise.sigma_rotation];
        let holdout = |ideal: &Ideal, noise| HeldOut::of(&campaign, ideal, noise, center);
        let of_poses = bench.holdout_poses.as_ref().unwrap_or(&bench.holdout);
        let poses = holdout(of_poses, Noise::stated(sigma[0], sigma[1]))?;
        let readings = match &bench.holdout_poses {
            None => poses.whole(),
            Some(_) => holdout(&bench.holdout, campaign.noise)?.whole(),
        };
        Ok(Self {
            true_stiffness: Vector6::from(bench.true_stiffness),
            center,
            gain: gain.column_iter().map(|c| Vector6::from_fn(|i, _| c[i])).collect(),
            std: Vector6::from_fn(|i, _| covariance[(i, i)].sqrt()),
            translations: poses.of_half(0),
            rotations: poses.of_half(1),
            readings,
            sigma,
        })
    }

    /// One trial; none when a compliance may be zero.
    pub fn trial(&self, rng: &mut Pcg64) -> Option<SpringsResult> {
        let mut moved = Vector6::zeros();
        for column in &self.gain {
            let z: f64 = StandardNormal.sample(rng);
            moved.axpy(z, column, 1.0);
        }
        let compliance = self.center + moved;
        let sure = |i: usize| compliance[i] > 0.0 && self.std[i] < SURE * compliance[i];
        if !(0..6).all(sure) {
            return None;
        }
        let (mut errors, mut covered) = ([0.0; 6], 0);
        for i in 0..6 {
            let k = 1.0 / compliance[i];
            errors[i] = k / self.true_stiffness[i] - 1.0;
            let std = self.std[i] * k * k;
            covered += u8::from((k - self.true_stiffness[i]).abs() <= COVERAGE_FACTOR * std);
        }
        let [t, r, readings] =
            [&self.translations, &self.rotations, &self.readings].map(|q| q.at(&moved).max(0.0).sqrt());
        let holdout = [t * self.sigma[0], r * self.sigma[1], readings];
        Some(SpringsResult { errors, covered, holdout })
    }

    /// Compliances without noise (m/N), and the standard error of each.
    pub fn without_noise(&self) -> (Vector6, Vector6) {
        (self.center, self.std)
    }
}

/// Compliances and gain of generalised least squares.
fn weighted(campaign: &Campaign) -> Result<(Vector6, DMatrix<f64>), Status> {
    let fit = fit_baseline(campaign).map_err(|_| Status::NoFit)?;
    if fit.solution.rank < 6 {
        return Err(Status::NotDetermined);
    }
    let state = Linearization::at(campaign, &fit.point).map_err(|_| Status::NoFit)?;
    let j = state.common_block();
    Ok((fit.point.compliances, inverse_of_normal(&j)? * j.transpose()))
}

/// Compliances and gain of the paper's estimator: every reading counts the same, meters beside radians.
fn unweighted(campaign: &Campaign) -> Result<(Vector6, DMatrix<f64>), Status> {
    let rows = 6 * campaign.groups.len();
    let (mut a, mut y, mut sigma) = (DMatrix::zeros(rows, 6), DVector::zeros(rows), Vec::with_capacity(rows));
    for (i, group) in campaign.groups.iter().enumerate() {
        let block =
            paper::block(&campaign.hexapod, &group.mean, campaign.measurand).map_err(|_| Status::NoFit)?;
        // The mean of n readings counts n times.
        let root = (group.rows.len() as f64).sqrt();
        a.fixed_view_mut::<6, 6>(6 * i, 0).copy_from(&(block * root));
        y.fixed_rows_mut::<6>(6 * i).copy_from(&(Vector6::from(group.mean.measured) * root));
        sigma.extend(group.sigma.map(|s| s * root));
    }
    let mut gain = inverse_of_normal(&a)? * a.transpose();
    let springs = &gain * y;
    for (mut column, s) in gain.column_iter_mut().zip(sigma) {
        column *= s;
    }
    Ok((Vector6::from_fn(|i, _| springs[i]), gain))
}

/// `(A'A)^-1`, columns scaled to unit length in between.
fn inverse_of_normal(a: &DMatrix<f64>) -> Result<DMatrix<f64>, Status> {
    /// Smallest over largest eigenvalue of the scaled normal matrix: below, rounding is all there is.
    const DETERMINED: f64 = 1e-12;
    let scale: Vec<f64> = a.column_iter().map(|c| c.norm()).collect();
    let scaled = DMatrix::from_fn(a.nrows(), 6, |i, j| a[(i, j)] / scale[j]);
    let normal = scaled.tr_mul(&scaled);
    let eigenvalues = normal.symmetric_eigenvalues();
    let share = eigenvalues.min() / eigenvalues.max();
    if share.is_nan() || share <= DETERMINED {
        return Err(Status::NotDetermined);
    }
    let inverse = normal.cholesky().ok_or(Status::NotDetermined)?.inverse();
    Ok(DMatrix::from_fn(6, 6, |i, j| inverse[(i, j)] / (scale[i] * scale[j])))
}

/// `constant - 2 slope' d + d' curve d`: mean square error of predictions as the compliances move by `d`.
#[derive(Debug, Clone)]
struct Quadratic {
    constant: f64,
    slope: Vector6,
    curve: Matrix6,
}

impl Quadratic {
    fn at(&self, d: &Vector6) -> f64 {
        self.constant - 2.0 * self.slope.dot(d) + d.dot(&(self.curve * d))
    }

    /// Of whitened residuals and columns that hold so many numbers.
    fn of(r: &DVector<f64>, h: &DMatrix<f64>, n: f64) -> Self {
        let (slope, curve) = (h.tr_mul(r) / n, h.tr_mul(h) / n);
        Self {
            constant: r.norm_squared() / n,
            slope: Vector6::from_fn(|i, _| slope[i]),
            curve: Matrix6::from_fn(|i, j| curve[(i, j)]),
        }
    }
}

/// Errors of predictions around compliances, in standard deviations, and how they move with the compliances.
struct HeldOut {
    residuals: DVector<f64>,
    columns: DMatrix<f64>,
    /// Numbers among the rows: a row whose number was not read holds none.
    numbers: f64,
}

impl HeldOut {
    fn of(campaign: &Campaign, ideal: &Ideal, noise: Noise, springs: Vector6) -> Result<Self, Status> {
        let holdout = ideal.dataset("holdout", None);
        let judged = Campaign::with_noise(&campaign.hexapod, &holdout, noise).map_err(|_| Status::NoFit)?;
        let point = ModelPoint { compliances: springs, ..ModelPoint::start(campaign) };
        let state = Linearization::at(&judged, &point).map_err(|_| Status::NoFit)?;
        Ok(Self { residuals: state.residuals(), columns: state.common_block(), numbers: state.numbers() })
    }

    /// Of the translations (0) or of the rotations (1) of full poses.
    fn of_half(&self, half: usize) -> Quadratic {
        let rows: Vec<usize> = (0..self.residuals.len()).filter(|k| (k % 6) / 3 == half).collect();
        let (residuals, columns) = (self.residuals.select_rows(&rows), self.columns.select_rows(&rows));
        Quadratic::of(&residuals, &columns, rows.len() as f64)
    }

    /// Of all numbers.
    fn whole(&self) -> Quadratic {
        Quadratic::of(&self.residuals, &self.columns, self.numbers)
    }
}
