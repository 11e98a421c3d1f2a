//! Readings held out from a fit beside what the fit foresees of them, the uncertainty of its parameters included.

use std::sync::Arc;

use hexbench_core::{Dataset, Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, DVectorView, SMatrix};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::equations::{Equations, by_rows};
use crate::estimation::fit::Fit;
use crate::estimation::linearization::{ModelPoint, beside};
use crate::estimation::noise::NoiseLevel;
use crate::estimation::nuisance::{FoundInputs, InputsAfterFit};
use crate::estimation::residuals::{Residual, errors_of, is_what_noise_gives};
use crate::estimation::tolerances::within_tolerances_of;
use crate::estimation::whitening::Inexact;

/// A fit with what its readings tell of the inputs that are known to a tolerance only: what other readings are foreseen by.
pub struct Predictive<'a> {
    fit: &'a Fit,
    known: KnownInputs,
}

/// What the readings of a fit tell of inputs, and whether it is believed.
pub(crate) struct KnownInputs {
    /// None where inputs count as exact.
    inputs: Option<InputsAfterFit>,
    /// True where the model leaves what noise gives, with inputs that their tolerances make likely: another model bends them to make up for
    /// what it lacks.
    is_believed: bool,
}

impl KnownInputs {
    /// After a fit of so many parameters to so many numbers that leaves this chi-square.
    pub(crate) fn new(
        inputs: Option<InputsAfterFit>,
        lack_of_fit: f64,
        numbers: f64,
        parameters: usize,
    ) -> Self {
        let dof = (numbers - parameters as f64).max(1.0);
        let is_likely = inputs.as_ref().is_none_or(InputsAfterFit::is_likely);
        Self { inputs, is_believed: is_likely && is_what_noise_gives(lack_of_fit / dof, dof) }
    }

    /// After a fit to a campaign that ended at a point.
    fn at(campaign: &Campaign, point: &ModelPoint) -> Result<Self, ModelError> {
        if campaign.inexact.is_none() {
            return Ok(Self { inputs: None, is_believed: true });
        }
        Ok(Self::by(&Equations::at(campaign, point)?, campaign))
    }

    /// The same by the equations of the campaign there.
    pub(crate) fn by(equations: &Equations, campaign: &Campaign) -> Self {
        if campaign.inexact.is_none() {
            return Self { inputs: None, is_believed: true };
        }
        let (left, parameters) = (equations.lack_of_fit(), equations.own().ncols() - 1);
        Self::new(equations.inputs_after_fit(), left, campaign.averaged_numbers(), parameters)
    }
}

impl<'a> Predictive<'a> {
    /// Of a fit to a campaign.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn of(campaign: &Campaign, fit: &'a Fit) -> Result<Self, ModelError> {
        Ok(Self { fit, known: KnownInputs::at(campaign, &fit.point)? })
    }

    /// Of a fit, and what is known of the inputs after it.
    pub(crate) fn knowing(fit: &'a Fit, known: KnownInputs) -> Self {
        Self { fit, known }
    }

    /// What it foresees of readings held out; what they share is part of the noise of each.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn foreseen(&self, held: Campaign) -> Result<Foreseen, ModelError> {
        let equations = Equations::at(&held, &self.fit.point)?;
        Ok(self.foreseen_by(equations, held))
    }

    /// The same where the equations of the readings at the fit are at hand.
    pub(crate) fn foreseen_by(&self, equations: Equations, held: Campaign) -> Foreseen {
        let as_stated = (!self.known.is_believed).then(|| Misfit::between(&equations, &held, self.fit));
        let (equations, held) = told(self.known.inputs.as_ref(), equations, held);
        let foreseen = Foreseen::by_equations(equations, &held, self);
        Foreseen { misfit: as_stated.unwrap_or(foreseen.misfit), ..foreseen }
    }

    /// How far readings held out are from that.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn misfit(&self, held: Campaign) -> Result<Misfit, ModelError> {
        let inputs = self.known.inputs.as_ref().filter(|_| self.known.is_believed);
        let (equations, held) = told(inputs, Equations::at(&held, &self.fit.point)?, held);
        Ok(Misfit::between(&equations, &held, self.fit))
    }
}

/// Averaged readings that a fit has not seen, beside what it foresees of them.
///
/// ```text
/// r ~ N(0, I + Z Z'),   Z = [J C^1/2, U]
/// ```
///
/// with the residuals `r` and the columns `J` of the parameters over the noise of the readings, the covariance `C` of the parameters,
/// and the columns `U` of inputs that are known to a tolerance, all with what the readings of the fit tell of these inputs. Six rows for
/// each condition.
#[derive(Debug, Clone)]
pub struct Foreseen {
    /// Bits of the commanded pose of each condition.
    pub(crate) poses: Vec<[u64; 6]>,
    /// `r`.
    pub(crate) residuals: DVector<f64>,
    /// True where these are the errors of the model; elsewhere those with inputs as stated are.
    is_believed: bool,
    /// What the readings of the fit tell of the inputs; none where these count as exact.
    found: Option<FoundInputs>,
    /// `Z`.
    pub(crate) spread: Spread,
    /// How far the readings are from what is foreseen, taken together; with inputs as stated where the model bends them.
    pub misfit: Misfit,
}

impl Foreseen {
    /// Of readings whose equations at a fit are at hand, their inputs as the fit leaves them.
    fn by_equations(equations: Equations, held: &Campaign, predictive: &Predictive<'_>) -> Self {
        let fit = predictive.fit;
        let misfit = Misfit::between(&equations, held, fit);
        let (columns, residuals) = equations.over_all_noise(held);
        let root = root(&fit.covariance);
        let parameters = columns * &root;
        Self {
            poses: held.groups.iter().map(|group| group.mean.pose.bits()).collect(),
            residuals,
            is_believed: predictive.known.is_believed,
            found: predictive.known.inputs.as_ref().map(|inputs| inputs.by_deviations(&root)),
            spread: Spread { parameters, inputs: held.inexact.clone(), shares: held.own_shares() },
            misfit,
        }
    }

    /// Errors of the model: `r`, or what it leaves with inputs as stated where it bends them to make up for what it lacks.
    pub(crate) fn errors(&self) -> DVector<f64> {
        let (Some(found), Some(inputs), false) = (&self.found, &self.spread.inputs, self.is_believed) else {
            return self.residuals.clone();
        };
        &self.residuals + (&inputs.columns * &found.mean).component_mul(&self.spread.shares)
    }

    /// `r` where the inputs are those that another model of the same readings has found, and the parameters follow: a model that lacks an
    /// effect bends the inputs to make up for it.
    pub(crate) fn residuals_at_inputs_of(&self, other: &Self) -> DVector<f64> {
        let both = self.found.as_ref().zip(other.found.as_ref());
        let Some((own, moved)) = both.and_then(|(own, theirs)| Some((own, own.moved_to(theirs)?))) else {
            return self.residuals.clone();
        };
        let mut residuals = &self.residuals + &self.spread.parameters * own.slope.tr_mul(&moved);
        if let Some(inputs) = &self.spread.inputs {
            residuals -= (&inputs.columns * moved).component_mul(&self.spread.shares);
        }
        residuals
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
pub fn held_campaign(
    campaign: &Campaign,
    holdout: &Dataset,
    point: &ModelPoint,
) -> Result<Campaign, ModelError> {
    let held = Campaign::held_out(&campaign.hexapod, holdout, campaign.noise, &point.machine)?;
    Ok(within_tolerances_of(campaign, held))
}

/// What a fit to a campaign that ended at a point leaves of every reading held out, in file order.
///
/// # Errors
/// As [`held_campaign`].
pub fn held_out_residuals(
    campaign: &Campaign,
    holdout: &Dataset,
    point: &ModelPoint,
) -> Result<Vec<Residual>, ModelError> {
    let held = held_campaign(campaign, holdout, point)?;
    let KnownInputs { inputs, is_believed } = KnownInputs::at(campaign, point)?;
    let (equations, held) = told(inputs.as_ref().filter(|_| is_believed), Equations::at(&held, point)?, held);
    Ok(errors_of(&equations.over_all_noise(&held).1, &held, &holdout.observations))
}

/// What the readings of a campaign tell of their inputs after a fit that ended at a point; none where inputs count as exact.
pub(crate) fn inputs_after(
    campaign: &Campaign,
    point: &ModelPoint,
) -> Result<Option<InputsAfterFit>, ModelError> {
    Ok(KnownInputs::at(campaign, point)?.inputs)
}

/// Readings with what a fit tells of their inputs taken off, and what it leaves of these.
fn told(inputs: Option<&InputsAfterFit>, equations: Equations, held: Campaign) -> (Equations, Campaign) {
    let (Some(inputs), Some(known)) = (inputs, held.inexact.clone()) else { return (equations, held) };
    let left = inputs.left(&known.columns);
    let share = inputs.share_of(&left);
    let held = held.with_inexact(left, Arc::clone(&known.machine));
    (equations.without(&share, &held), held)
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
    /// By the equations of readings at a fit.
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

/// How far readings held out are from what a fit to a campaign foresees.
///
/// # Errors
/// As [`held_campaign`].
pub fn held_out_misfit(campaign: &Campaign, holdout: &Dataset, fit: &Fit) -> Result<Misfit, ModelError> {
    Predictive::of(campaign, fit)?.misfit(held_campaign(campaign, holdout, &fit.point)?)
}

/// Chance that held-out readings are as far from a fit to a campaign as they are, or farther, if the model is right: beside noise with
/// all that is known of it, inputs within their tolerances, and the uncertainty of every parameter, which all readings share; pure
/// error left out.
///
/// # Errors
/// As [`held_campaign`] and [`Misfit::chance`].
pub fn held_out_chance(campaign: &Campaign, holdout: &Dataset, fit: &Fit) -> Result<f64, ModelError> {
    held_out_misfit(campaign, holdout, fit)?.chance(campaign.noise_level())
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
        let fit = fit_baseline(&campaign).unwrap();
        let foreseen = Predictive::of(&campaign, &fit).unwrap().foreseen(campaign.clone()).unwrap();
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
