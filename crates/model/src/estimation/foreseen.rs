//! Readings held out from a fit beside what the fit foresees of them, the uncertainty of its parameters included.

use std::sync::Arc;

use hexbench_core::{Dataset, Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, DVectorView, SMatrix};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::equations::{Equations, by_rows};
use crate::estimation::fit::Fit;
use crate::estimation::linearization::beside;
use crate::estimation::noise::NoiseLevel;
use crate::estimation::tolerances::within_tolerances_of;
use crate::estimation::whitening::Inexact;

/// Averaged readings that a fit has not seen, beside what it foresees of them.
///
/// ```text
/// r ~ N(0, I + Z Z'),   Z = [J C^1/2, U]
/// ```
///
/// with the residuals `r` and the columns `J` of the parameters over the noise of the readings, the covariance `C` of the parameters,
/// and the columns `U` of inputs that are known to a tolerance. Six rows for each condition.
#[derive(Debug, Clone)]
pub struct Foreseen {
    /// Bits of the commanded pose of each condition.
    pub(crate) poses: Vec<[u64; 6]>,
    /// `r`.
    pub(crate) residuals: DVector<f64>,
    /// `Z`.
    pub(crate) spread: Spread,
    /// How far the readings are from what is foreseen, taken together.
    pub misfit: Misfit,
}

impl Foreseen {
    /// What a fit foresees of held-out readings; what they share is part of the noise of each.
    ///
    /// # Errors
    /// As [`fit`](crate::estimation::fit::fit).
    pub fn of(held: &Campaign, fit: &Fit) -> Result<Self, ModelError> {
        Ok(Self::by_equations(Equations::at(held, &fit.point)?, held, fit))
    }

    /// The same where the equations of the readings at the fit are at hand.
    pub(crate) fn by_equations(equations: Equations, held: &Campaign, fit: &Fit) -> Self {
        let misfit = Misfit::between(&equations, held, fit);
        let (columns, residuals) = equations.over_all_noise(held);
        let parameters = columns * root(&fit.covariance);
        Self {
            poses: held.groups.iter().map(|group| group.mean.pose.bits()).collect(),
            residuals,
            spread: Spread { parameters, inputs: held.inexact.clone(), shares: held.own_shares() },
            misfit,
        }
    }

    /// Residual of one condition.
    pub(crate) fn residual(&self, condition: usize) -> Vector6 {
        self.residuals.fixed_rows::<6>(6 * condition).into_owned()
    }

    /// Covariance of the residual of one condition: noise and uncertainty.
    pub(crate) fn covariance(&self, condition: usize) -> Matrix6 {
        let z = self.spread.of(condition);
        let product: SMatrix<f64, 6, 6> = (&z * z.transpose()).fixed_view::<6, 6>(0, 0).into_owned();
        Matrix6::identity() + product
    }
}

/// `Z` of readings held out. The columns of inputs are those of their campaign, of which there are dozens for each number.
#[derive(Debug, Clone)]
pub(crate) struct Spread {
    /// `J C^1/2`.
    parameters: DMatrix<f64>,
    /// `U` over the noise of each number that is its own; none where inputs count as exact.
    inputs: Option<Arc<Inexact>>,
    /// Standard deviation of that noise over all of it.
    shares: DVector<f64>,
}

impl Spread {
    /// Rows of one condition.
    fn of(&self, condition: usize) -> DMatrix<f64> {
        let rows = |all: &DMatrix<f64>| all.rows(6 * condition, 6).into_owned();
        let shares = self.shares.rows(6 * condition, 6).into_owned();
        let inputs = self.inputs.iter().map(|inputs| by_rows(rows(&inputs.columns), &shares));
        beside(&std::iter::once(rows(&self.parameters)).chain(inputs).collect::<Vec<_>>())
    }

    /// `|Z' x|^2`.
    pub(crate) fn squared_along(&self, x: &DVector<f64>) -> f64 {
        let share = |column: DVectorView<'_, f64>| column.component_mul(&self.shares).dot(x);
        let inputs = self.inputs.iter().flat_map(|inputs| inputs.columns.column_iter().map(share));
        let parameters = self.parameters.column_iter().map(|column| column.dot(x));
        DVector::from_vec(parameters.chain(inputs).collect()).norm_squared()
    }
}

/// Held-out readings in the frames of a fit to a campaign, their inputs as good as those of the campaign.
///
/// # Errors
/// As [`Campaign::held_out`].
pub fn held_campaign(campaign: &Campaign, holdout: &Dataset, fit: &Fit) -> Result<Campaign, ModelError> {
    let held = Campaign::held_out(&campaign.hexapod, holdout, campaign.noise, &fit.point.machine)?;
    Ok(within_tolerances_of(campaign, held))
}

/// How far held-out readings are from what a fit foresees.
///
/// ```text
/// chi2 = d' (I + Z Z')^-1 d,   Z = J C^1/2
/// ```
///
/// with the residuals `d` and columns `J` freed of what the readings have in common (noise, inputs within their tolerances).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Misfit {
    pub(crate) chi2: f64,
    pub(crate) numbers: f64,
}

impl Misfit {
    /// Of readings held out from a fit.
    ///
    /// # Errors
    /// As [`fit`](crate::estimation::fit::fit).
    pub fn of(held: &Campaign, fit: &Fit) -> Result<Self, ModelError> {
        Ok(Self::between(&Equations::at(held, &fit.point)?, held, fit))
    }

    /// The same where the equations of the readings are at hand.
    fn between(equations: &Equations, held: &Campaign, fit: &Fit) -> Self {
        let (columns, d) = equations.whitened();
        let z = columns * root(&fit.covariance);
        let inner = z.tr_mul(&z) + DMatrix::identity(z.ncols(), z.ncols());
        let along = z.tr_mul(&d);
        let explained = inner.cholesky().map_or(0.0, |factor| along.dot(&factor.solve(&along)));
        Self { chi2: (d.norm_squared() - explained).max(0.0), numbers: held.averaged_numbers() }
    }

    /// Of all readings, each left out of one of several fits that share most of theirs: so many numbers scatter like the degrees of
    /// freedom of the fit to all of them (for equal leverages their sum is the residual chi-square of that fit, enlarged).
    #[must_use]
    pub fn left_out_in_turn(parts: impl Iterator<Item = Self>, dof: f64) -> Self {
        let sum = parts.fold(Self::default(), |all, one| Self {
            chi2: all.chi2 + one.chi2,
            numbers: all.numbers + one.numbers,
        });
        let numbers = dof.clamp(0.0, sum.numbers);
        Self { chi2: sum.chi2 * numbers / sum.numbers.max(1.0), numbers }
    }

    /// Chance of a misfit like this or larger if the model is right; `chi2 / n over sum / dof` follows `F(n, dof)`, with what is known
    /// of the noise level.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] without a number to judge by.
    pub fn chance(&self, level: NoiseLevel) -> Result<f64, ModelError> {
        let NoiseLevel { sum, dof } = level;
        let unknown = || ModelError::NotFinite { what: "the held-out data" };
        let above = if dof.is_finite() && dof > 0.0 {
            let law = FisherSnedecor::new(self.numbers, dof).map_err(|_| unknown())?;
            law.sf(self.chi2 / self.numbers * dof / sum)
        } else {
            ChiSquared::new(self.numbers).map_err(|_| unknown())?.sf(self.chi2)
        };
        if above.is_finite() { Ok(above) } else { Err(unknown()) }
    }
}

/// Chance that held-out readings are as far from a fit to a campaign as they are, or farther, if the model is right: beside noise with
/// all that is known of it, inputs within their tolerances, and the uncertainty of every parameter, which all readings share; pure
/// error left out.
///
/// # Errors
/// As [`held_campaign`] and [`Misfit::chance`].
pub fn held_out_chance(campaign: &Campaign, holdout: &Dataset, fit: &Fit) -> Result<f64, ModelError> {
    Misfit::of(&held_campaign(campaign, holdout, fit)?, fit)?.chance(campaign.noise_level())
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

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::estimation::fit::fit_baseline;
    use crate::estimation::noise::Noise;
    use crate::estimation::tolerances::within_tolerances;
    use crate::test_machine::readings;

    #[test]
    fn the_spread_of_all_conditions_is_that_of_each() {
        let (hexapod, data) = readings(Measurand::DeflectionEuler, Vec::new());
        let campaign =
            within_tolerances(Campaign::with_noise(&hexapod, &data, Noise::stated(1e-7, 6e-7)).unwrap());
        let foreseen = Foreseen::of(&campaign, &fit_baseline(&campaign).unwrap()).unwrap();
        let x = DVector::from_fn(foreseen.residuals.len(), |i, _| ((1 + i * i) as f64).sin());
        let along = |condition: usize| {
            let of_one = x.rows(6 * condition, 6);
            foreseen.spread.of(condition).tr_mul(&of_one)
        };
        let sum = (0..campaign.groups.len()).map(along).reduce(|a, b| a + b).unwrap().norm_squared();
        let all = foreseen.spread.squared_along(&x);
        assert!(sum > 0.0 && (all / sum - 1.0).abs() < 1e-12, "{all} {sum}");
    }
}
