//! Residuals of single readings, error summaries, and errors on held-out poses.

use std::collections::HashMap;

use hexbench_core::statistics::{mean, median};
use hexbench_core::{Dataset, Hexapod, Matrix6, Observation, Vector6};
use nalgebra::DMatrix;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, ConditionReadings, row_sigma};
use crate::estimation::fit::{Fit, Start, TermSpec, columns, refit};
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::estimation::lsq::solve;
use crate::estimation::noise::{Noise, NoiseLevel};
use crate::estimation::tolerances::within_tolerances_at;

/// Most folds of a leave-poses-out validation.
const MOST_FOLDS: usize = 12;

/// Residual of one reading: measured minus predicted, in measured coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// Index of the reading in the dataset.
    pub row: usize,
    /// Index of its condition.
    pub condition: usize,
    /// m and rad.
    pub value: Vector6,
    /// Divided by the standard deviation of one reading.
    pub whitened: Vector6,
}

/// Size of a set of residuals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct ErrorSummary {
    /// Sum of squared whitened residuals per degree of freedom (per number for held-out data).
    pub chi2_reduced: f64,
    /// Root mean square of the residuals.
    pub rms: Rms,
    /// Root mean square of each coordinate: um for translations, urad for rotations.
    pub per_coordinate: [f64; 6],
    /// Scalar residuals behind it.
    pub count: usize,
}

/// Least excess of the held-out chi-square that counts as above the noise.
const LEAST_EXCESS: f64 = 0.2;
/// Standard deviations of a reduced chi-square that chance allows.
const CHANCE: f64 = 3.1;

impl ErrorSummary {
    /// The error as a multiple of the noise.
    pub fn times_noise(&self) -> f64 {
        self.chi2_reduced.sqrt()
    }

    /// True when the error is what the noise gives, a little model uncertainty included.
    pub fn is_at_the_noise(&self) -> bool {
        let spread = CHANCE * (2.0 / self.count.max(1) as f64).sqrt();
        self.chi2_reduced < 1.0 + spread.max(LEAST_EXCESS)
    }
}

/// Root mean square in the units people read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Rms {
    /// Over the three translations, um.
    pub translation_um: f64,
    /// Over the three rotations, urad.
    pub rotation_urad: f64,
}

/// Residuals of every reading behind a linearisation, in file order.
pub fn residuals(campaign: &Campaign, rows: &[Observation], lin: &Linearization) -> Vec<Residual> {
    let mut all: Vec<Residual> = Vec::with_capacity(rows.len());
    for (condition, group) in campaign.groups.iter().enumerate() {
        let mean = lin.residual(condition);
        for &row in &group.rows {
            let reading = &rows[row as usize];
            let sigma = row_sigma(reading, &campaign.noise);
            let off = campaign.axes.difference(&group.mean.measured, &reading.measured);
            let value = Vector6::from_fn(|k, _| mean[k] * group.sigma[k] + off[k]);
            let whitened = Vector6::from_fn(|k, _| value[k] / sigma[k]);
            all.push(Residual { row: row as usize, condition, value, whitened });
        }
    }
    all.sort_by_key(|r| r.row);
    all
}

/// Summarise residuals; `dof` of the chi-square, or their number when `None`.
pub fn summarise(residuals: &[Residual], dof: Option<f64>) -> ErrorSummary {
    let n = residuals.len().max(1) as f64;
    let square = |k: usize| mean(residuals.iter().map(|r| r.value[k] * r.value[k])).unwrap_or(0.0);
    let mean_square: [f64; 6] = std::array::from_fn(square);
    let chi2: f64 = residuals.iter().map(|r| r.whitened.norm_squared()).sum();
    let root = |from: usize| mean(mean_square[from..from + 3].iter().copied()).unwrap_or(0.0).sqrt() * 1e6;
    ErrorSummary {
        chi2_reduced: chi2 / dof.unwrap_or(6.0 * n).max(1.0),
        rms: Rms { translation_um: root(0), rotation_urad: root(3) },
        per_coordinate: mean_square.map(|s| s.sqrt() * 1e6),
        count: 6 * residuals.len(),
    }
}

/// Median of the squared length of whitened residuals over what noise alone would give, so that a bad model does not
/// make every reading suspect.
pub(crate) fn typical_square(rows: &[Residual]) -> f64 {
    const MEDIAN_OF_SIX: f64 = 5.348;
    median(rows.iter().map(|r| r.whitened.norm_squared())).unwrap_or(0.0) / MEDIAN_OF_SIX
}

/// Prediction errors of a fitted model on other readings.
///
/// # Errors
/// [`ModelError::Mismatch`] when the readings are of another kind than those fitted, [`ModelError::SingularPose`].
pub fn prediction_errors(
    hexapod: &Hexapod,
    holdout: &Dataset,
    noise: Noise,
    point: &ModelPoint,
) -> Result<Vec<Residual>, ModelError> {
    let campaign = Campaign::held_out(hexapod, holdout, noise, &point.machine)?.independent();
    let lin = Linearization::at(&campaign, point)?;
    Ok(residuals(&campaign, &holdout.observations, &lin))
}

/// Chance that held-out readings are as far from a fit to a campaign as they are, or farther, if the model is right: beside noise with
/// all that is known of it, inputs within their tolerances, and the uncertainty of every parameter, which all readings share; pure
/// error left out.
///
/// ```text
/// chi2 = d' (I + Z Z')^-1 d,   Z = J C^1/2,   chi2 / n over sum / dof follows F(n, dof)
/// ```
///
/// with the residuals `d` and columns `J` whitened, the covariance `C` of the parameters, and what is known of the noise level.
///
/// # Errors
/// As [`prediction_errors`].
pub fn held_out_chance(campaign: &Campaign, holdout: &Dataset, fit: &Fit) -> Result<f64, ModelError> {
    let held = Campaign::held_out(&campaign.hexapod, holdout, campaign.noise, &fit.point.machine)?;
    let held = if campaign.inexact.is_some() { within_tolerances_at(held, &fit.point) } else { held };
    let lin = Linearization::at(&held, &fit.point)?;
    let d = lin.residuals();
    let z = columns(&lin, &fit.point) * root(&fit.covariance);
    let inner = z.tr_mul(&z) + DMatrix::identity(z.ncols(), z.ncols());
    let along = z.tr_mul(&d);
    let explained = inner.cholesky().map_or(0.0, |factor| along.dot(&factor.solve(&along)));
    let (chi2, numbers) = ((d.norm_squared() - explained).max(0.0), d.len() as f64);
    let NoiseLevel { sum, dof } = campaign.noise_level();
    let unknown = || ModelError::NotFinite { what: "the held-out data" };
    let below = if dof.is_finite() && dof > 0.0 {
        let law = FisherSnedecor::new(numbers, dof).map_err(|_| unknown())?;
        law.cdf(chi2 / numbers * dof / sum)
    } else {
        ChiSquared::new(numbers).map_err(|_| unknown())?.cdf(chi2)
    };
    Ok(1.0 - below)
}

/// By how much held-out chi-square falls when more columns are fitted to a campaign beside a fit: below zero when they predict worse.
///
/// # Errors
/// As [`prediction_errors`] and [`solve`].
pub fn held_out_gain(
    campaign: &Campaign,
    holdout: &Dataset,
    fit: &Fit,
    more: impl Fn(&Linearization) -> DMatrix<f64>,
) -> Result<f64, ModelError> {
    let with = |lin: &Linearization| beside(&[columns(lin, &fit.point), more(lin)]);
    let here = Linearization::at(campaign, &fit.point)?;
    let increments = solve(&with(&here), &here.residuals())?.x;
    let held = Campaign::held_out(&campaign.hexapod, holdout, campaign.noise, &fit.point.machine)?;
    let there = Linearization::at(&held, &fit.point)?;
    let before = there.residuals();
    let after = &before - with(&there) * increments;
    Ok(before.norm_squared() - after.norm_squared())
}

/// A square root of a covariance, `C = R R'`; its entries may differ by many orders.
fn root(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let sizes = covariance.diagonal().map(|x| x.max(0.0).sqrt());
    let share = |i: usize, j: usize| {
        let product = sizes[i] * sizes[j];
        if product > 0.0 { covariance[(i, j)] / product } else { 0.0 }
    };
    let n = sizes.len();
    let eigen = DMatrix::from_fn(n, n, share).symmetric_eigen();
    let lengths = eigen.eigenvalues.map(|x| x.max(0.0).sqrt());
    DMatrix::from_diagonal(&sizes) * eigen.eigenvectors * DMatrix::from_diagonal(&lengths)
}

/// Averaged readings beside what a fit expects of them, uncertainty of its parameters included.
struct Expected {
    /// Sum of squared distances in units of noise plus uncertainty.
    chi2: f64,
    /// Logarithm of the determinant of noise plus uncertainty, in units of the noise.
    log_det: f64,
}

impl Expected {
    /// `lin` is the fit seen at these readings.
    fn of(lin: &Linearization, fit: &Fit) -> Self {
        let jacobian = columns(lin, &fit.point);
        let mut expected = Self { chi2: 0.0, log_det: 0.0 };
        for i in 0..lin.conditions.len() {
            let j = jacobian.rows(6 * i, 6);
            let spread = j * &fit.covariance * j.transpose();
            let total = Matrix6::identity() + spread.fixed_view::<6, 6>(0, 0);
            let Some(factor) = total.cholesky() else { continue };
            let d = lin.residual(i);
            expected.chi2 += d.dot(&factor.solve(&d));
            expected.log_det += 2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>();
        }
        expected
    }

    /// Logarithm of the predictive density of the readings, up to a constant of the noise.
    fn log_density(&self) -> f64 {
        -0.5 * (self.chi2 + self.log_det)
    }
}

/// Errors on poses left out in turn.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Of every reading.
    pub residuals: Vec<Residual>,
    /// Sum of the logarithms of the predictive densities of what was left out (Geisser and Eddy 1979, Journal of the American
    /// Statistical Association 74): unlike the errors it does not hold against an effect that the pose left out was the only one to
    /// determine it.
    pub log_density: f64,
}

/// Prediction errors when poses are left out in turn and the model is fitted to the others; `rows` are the readings of the campaign.
///
/// # Errors
/// As [`fit`](crate::estimation::fit::fit); [`ModelError::TooFewEquations`] with fewer than two poses.
pub fn leave_poses_out(
    campaign: &Campaign,
    rows: &[Observation],
    wanted: &[TermSpec],
    start: &ModelPoint,
) -> Result<LeftOut, ModelError> {
    let fold_of = folds(campaign);
    let count = fold_of.iter().max().map_or(0, |last| last + 1);
    if count < 2 {
        return Err(ModelError::TooFewEquations { equations: 6, unknowns: 12 });
    }
    let start = Start::at(campaign, wanted, start)?;
    let errors: Vec<(Vec<Residual>, f64)> = (0..count)
        .into_par_iter()
        .map(|fold| {
            let [kept, held] = [false, true].map(|inside| {
                (0..fold_of.len()).filter(|&g| (fold_of[g] == fold) == inside).collect::<Vec<_>>()
            });
            let fitted = refit(campaign, wanted, &start, &kept)?;
            let held = campaign.part(&held).independent();
            let lin = Linearization::at(&held, &fitted.point)?;
            Ok((residuals(&held, rows, &lin), Expected::of(&lin, &fitted).log_density()))
        })
        .collect::<Result<_, ModelError>>()?;
    let log_density = errors.iter().map(|e| e.1).sum();
    Ok(LeftOut { residuals: errors.into_iter().flat_map(|e| e.0).collect(), log_density })
}

/// Fold of every group: groups of equal pose belong to one; poses are dealt out in order of appearance.
fn folds(campaign: &Campaign) -> Vec<usize> {
    let mut known = HashMap::new();
    let number = |g: &ConditionReadings| {
        let next = known.len();
        *known.entry(g.mean.pose.to_array().map(|x| (x + 0.0).to_bits())).or_insert(next)
    };
    let poses: Vec<usize> = campaign.groups.iter().map(number).collect();
    let count = known.len().clamp(1, MOST_FOLDS);
    poses.into_iter().map(|pose| pose % count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_held_out_numbers_allow_more_scatter() {
        let rms = Rms { translation_um: 1.0, rotation_urad: 1.0 };
        let at = |chi2_reduced, count| {
            ErrorSummary { chi2_reduced, rms, per_coordinate: [1.0; 6], count }.is_at_the_noise()
        };
        assert!(at(1.3, 180) && !at(1.4, 180));
        assert!(at(1.5, 60) && !at(1.3, 100_000));
    }
}
