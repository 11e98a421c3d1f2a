//! Residuals of single readings, error summaries, and errors on held-out poses.

use std::collections::HashMap;

use hexbench_core::parallel;
use hexbench_core::statistics::{mean, median, root_mean_square};
use hexbench_core::{Dataset, Hexapod, NumberKind, Observation, Vector6};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, ConditionReadings, row_sigma};
use crate::estimation::fit::{Fit, Start, TermSpec, columns};
use crate::estimation::folds::{FoldFit, FoldFits};
use crate::estimation::foreseen::{Foreseen, Misfit};
use crate::estimation::linearization::{Linearization, ModelPoint, beside, own_residuals};
use crate::estimation::lsq::solve;
use crate::estimation::noise::Noise;

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
    /// Divided by the standard deviation of one reading; zero for what was not read.
    pub whitened: Vector6,
    /// What the numbers are.
    pub kinds: [NumberKind; 6],
}

impl Residual {
    /// How many numbers were read.
    pub fn numbers(&self) -> usize {
        self.kinds.iter().filter(|kind| **kind != NumberKind::Unread).count()
    }

    /// The number of it that is farthest from zero, divided by the standard deviation of one reading.
    pub fn farthest(&self) -> f64 {
        self.whitened.iter().copied().fold(0.0, |most, one| if one.abs() > most.abs() { one } else { most })
    }
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

    /// Standard deviation of that multiple where the noise is all there is: of `n` numbers, `1 / sqrt(2 n)`.
    pub fn band(&self) -> f64 {
        (2.0 * self.count.max(1) as f64).sqrt().recip()
    }

    /// What the noise does not give of the error, as a multiple of the noise.
    pub fn beyond_noise(&self) -> f64 {
        (self.chi2_reduced - 1.0).max(0.0).sqrt()
    }

    /// True when the error is what the noise gives, a little model uncertainty included.
    pub fn is_at_the_noise(&self) -> bool {
        is_what_noise_gives(self.chi2_reduced, self.count.max(1) as f64)
    }
}

/// True when a chi-square per degree of freedom is what the noise gives, a little model uncertainty included.
pub(crate) fn is_what_noise_gives(chi2_reduced: f64, dof: f64) -> bool {
    chi2_reduced < 1.0 + (CHANCE * (2.0 / dof).sqrt()).max(LEAST_EXCESS)
}

/// Root mean square in the units people read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Rms {
    /// Over translations, and lengths that sensors read, um; none where none was read.
    pub translation_um: Option<f64>,
    /// Over rotations, and angles that sensors read, urad; none where none was read.
    pub rotation_urad: Option<f64>,
}

impl Rms {
    /// Of lengths, um, and of angles, urad.
    pub fn both(&self) -> [Option<f64>; 2] {
        [self.translation_um, self.rotation_urad]
    }
}

/// Residuals of every reading, in file order; `of` an averaged one: what the model leaves of it, weighted by what is its own.
pub fn residuals(campaign: &Campaign, rows: &[Observation], of: impl Fn(usize) -> Vector6) -> Vec<Residual> {
    let mut all: Vec<Residual> =
        Vec::with_capacity(campaign.groups.iter().map(|group| group.rows.len()).sum());
    for (condition, group) in campaign.groups.iter().enumerate() {
        let mean = group.weights().numbers(of(condition));
        for &row in &group.rows {
            let reading = &rows[row as usize];
            let sigma = row_sigma(reading, &campaign.noise);
            let off = campaign.axes.difference(&group.mean.measured, &reading.measured);
            let kinds = campaign.kinds_of(group, &sigma);
            let one = |k: usize| mean[k] + off[k];
            let value = Vector6::from_fn(|k, _| if kinds[k] == NumberKind::Unread { 0.0 } else { one(k) });
            let whitened = Vector6::from_fn(|k, _| value[k] / sigma[k]);
            all.push(Residual { row: row as usize, condition, value, whitened, kinds });
        }
    }
    all.sort_by_key(|r| r.row);
    all
}

/// The same at a point.
///
/// # Errors
/// As [`Linearization::at`].
pub fn residuals_at(
    campaign: &Campaign,
    rows: &[Observation],
    point: &ModelPoint,
) -> Result<Vec<Residual>, ModelError> {
    let own = own_residuals(campaign, point, |_, reading| *reading)?;
    Ok(residuals(campaign, rows, |i| own.fixed_rows::<6>(6 * i).into_owned()))
}

/// Summarize residuals; `dof` of the chi-square, or their number when `None`.
pub fn summarise(residuals: &[Residual], dof: Option<f64>) -> ErrorSummary {
    let count: usize = residuals.iter().map(Residual::numbers).sum();
    let is_read = |r: &&Residual, k: usize| r.kinds[k] != NumberKind::Unread;
    let square = |k: usize| {
        mean(residuals.iter().filter(|r| is_read(r, k)).map(|r| r.value[k] * r.value[k])).unwrap_or(0.0)
    };
    let mean_square: [f64; 6] = std::array::from_fn(square);
    let chi2: f64 = residuals.iter().map(|r| r.whitened.norm_squared()).sum();
    let root = |kind: NumberKind| {
        let of_row = |r: &Residual| {
            let (kinds, value) = (r.kinds, r.value);
            (0..6).filter(move |&k| kinds[k] == kind).map(move |k| value[k])
        };
        root_mean_square(residuals.iter().flat_map(of_row)).map(|rms| rms * 1e6)
    };
    ErrorSummary {
        chi2_reduced: chi2 / dof.unwrap_or(count as f64).max(1.0),
        rms: Rms { translation_um: root(NumberKind::Length), rotation_urad: root(NumberKind::Angle) },
        per_coordinate: mean_square.map(|s| s.sqrt() * 1e6),
        count,
    }
}

/// Median of the squared length of whitened residuals over what noise alone would give, so that a bad model does not
/// make every reading suspect.
pub(crate) fn typical_square(rows: &[Residual]) -> f64 {
    const MEDIAN_OF_SIX: f64 = 5.348;
    // The median of chi-square is nearly proportional to its degrees of freedom.
    let over = |r: &Residual| r.whitened.norm_squared() * 6.0 / r.numbers().max(1) as f64;
    median(rows.iter().map(over)).unwrap_or(0.0) / MEDIAN_OF_SIX
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
    residuals_at(&campaign, &holdout.observations, point)
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

/// Errors on poses left out in turn.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut<T> {
    /// Of every reading.
    pub residuals: Vec<Residual>,
    /// What is kept of what the fits to the others foresee of each part left out.
    pub kept: Vec<T>,
    misfits: Vec<Misfit>,
}

impl<T> LeftOut<T> {
    /// How far all of them are from what is foreseen; `dof`: degrees of freedom of the fit to all averaged readings.
    pub fn misfit(&self, dof: f64) -> Misfit {
        Misfit::left_out_in_turn(self.misfits.iter().copied(), dof)
    }
}

/// Prediction errors when poses are left out in turn and the model is fitted to the others; `rows` are the readings of the campaign,
/// `keep` makes what is kept of what each of these fits foresees.
///
/// # Errors
/// As [`fit`](crate::estimation::fit::fit); [`ModelError::TooFewEquations`] with fewer than two poses.
pub fn leave_poses_out<T: Send>(
    campaign: &Campaign,
    rows: &[Observation],
    wanted: &[TermSpec],
    start: Start,
    keep: impl Fn(Foreseen) -> T + Sync,
) -> Result<LeftOut<T>, ModelError> {
    let fits = FoldFits::from(campaign, wanted, start);
    let parts = each_part_left_out(campaign, MOST_FOLDS, |_, kept, held| {
        let FoldFit { part, foreseen } = fits.without(kept, held)?;
        Ok((errors_of(&foreseen.errors(), &part, rows), foreseen.misfit, keep(foreseen)))
    })?;
    let mut left =
        LeftOut { residuals: Vec::with_capacity(rows.len()), kept: Vec::new(), misfits: Vec::new() };
    for (residuals, misfit, kept) in parts {
        left.residuals.extend(residuals);
        left.misfits.push(misfit);
        left.kept.push(kept);
    }
    Ok(left)
}

/// Errors of readings held out, by what is left of the averaged ones over all of their noise.
pub(crate) fn errors_of(left: &DVector<f64>, held: &Campaign, rows: &[Observation]) -> Vec<Residual> {
    let own = left.component_div(&held.own_shares());
    residuals(held, rows, |i| own.fixed_rows::<6>(6 * i).into_owned())
}

/// What comes of leaving each part of the poses out, in order; of a part: its number, the groups kept, and those left out.
pub(crate) fn each_part_left_out<T: Send>(
    campaign: &Campaign,
    most: usize,
    of: impl Fn(usize, &[usize], &[usize]) -> Result<T, ModelError> + Sync,
) -> Result<Vec<T>, ModelError> {
    let fold_of = folds(campaign, most);
    let count = fold_of.iter().max().map_or(0, |last| last + 1);
    if count < 2 {
        return Err(ModelError::TooFewEquations { equations: 6, unknowns: 12 });
    }
    let part = |fold: usize| {
        let (held, kept): (Vec<usize>, Vec<usize>) = (0..fold_of.len()).partition(|&g| fold_of[g] == fold);
        of(fold, &kept, &held)
    };
    parallel::map_range(count, &part).into_iter().collect()
}

/// Fold of every group: groups of equal pose belong to one; poses are dealt out in order of appearance.
fn folds(campaign: &Campaign, most: usize) -> Vec<usize> {
    let mut known = HashMap::new();
    let number = |g: &ConditionReadings| {
        let next = known.len();
        *known.entry(g.mean.pose.bits()).or_insert(next)
    };
    let poses: Vec<usize> = campaign.groups.iter().map(number).collect();
    let count = known.len().clamp(1, most);
    poses.into_iter().map(|pose| pose % count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_held_out_numbers_allow_more_scatter() {
        let rms = Rms { translation_um: Some(1.0), rotation_urad: Some(1.0) };
        let at = |chi2_reduced, count| {
            ErrorSummary { chi2_reduced, rms, per_coordinate: [1.0; 6], count }.is_at_the_noise()
        };
        assert!(at(1.3, 180) && !at(1.4, 180));
        assert!(at(1.5, 60) && !at(1.3, 100_000));
    }

    #[test]
    fn the_farthest_number_keeps_its_sign() {
        let of = |last: f64| {
            let whitened = Vector6::new(1.0, -3.0, 2.0, 0.0, 0.0, last);
            Residual { row: 0, condition: 0, value: whitened, whitened, kinds: [NumberKind::Unread; 6] }
        };
        assert_eq!(
            [of(0.5).farthest(), of(4.0).farthest()].map(f64::to_bits),
            [-3.0_f64, 4.0].map(f64::to_bits)
        );
    }
}
