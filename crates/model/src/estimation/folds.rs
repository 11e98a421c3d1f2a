//! Fits without some of the poses, by taking their normal equations off those of all.
//!
//! One pass over the readings, linearized where the fit to all of them ended, gives the products of everything; a part left out is
//! multiplied by itself, so that each fit costs its own part and not the rest of the campaign. A fit that goes where the model is
//! no longer as it was linearized, or whose parameters the readings do not determine, is made in full.

use std::borrow::Cow;

use nalgebra::DMatrix;

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, rows_of};
use crate::estimation::equations::Equations;
use crate::estimation::fit::{Fit, Start, TermSpec, push_priors, refit, settled_at};
use crate::estimation::foreseen::{Foreseen, KnownInputs, Predictive};
use crate::estimation::lsq::{Solution, Triangle};
use crate::estimation::nuisance::InputsAfterFit;
use crate::estimation::parallel::products;
use crate::estimation::parameters::Parameters;

/// Root mean square departure of the readings left out from what was linearized, in standard deviations, up to which it holds.
const NEAR: f64 = 1e-3;
/// The same of what is foreseen of them from where a standard deviation of the parameters puts it: it adds in squares to that of the noise.
const NEAR_IN_SPREAD: f64 = 1e-2;
/// Smallest singular value over the largest for which normal equations have digits to spare.
const WELL_DETERMINED: f64 = 1e-5;

/// Fits to all of a campaign but a part.
pub(crate) struct FoldFits<'a> {
    campaign: &'a Campaign,
    wanted: &'a [TermSpec],
    start: Start,
    parameters: Parameters,
    /// Products of `[A y U]`: columns of the parameters, residuals, columns of the inputs that are known to a tolerance only, each reading
    /// over the standard deviation of its own noise; none where readings share errors.
    total: Option<DMatrix<f64>>,
}

/// A fit without a part of the readings, what the others tell of the inputs, and the equations of that part at the fit, each weighed by what
/// is its own.
struct Solved {
    fit: Fit,
    inputs: Option<InputsAfterFit>,
    there: Equations,
}

/// Readings left out, and what the fit to the others foresees of them.
pub(crate) struct FoldFit {
    pub(crate) part: Campaign,
    pub(crate) foreseen: Foreseen,
}

impl<'a> FoldFits<'a> {
    /// With the wanted terms, from a point.
    pub(crate) fn from(campaign: &'a Campaign, wanted: &'a [TermSpec], start: Start) -> Self {
        let parameters = Parameters::at(&start.point, campaign.is_absolute()).with_priors(wanted);
        let equations = &start.equations;
        let total = equations.noise_is_independent().then(|| {
            products_beside(equations.own(), equations.inexact().map(|all| (all.z(), all.products())))
        });
        Self { campaign, wanted, start, parameters, total }
    }

    /// The fit without the groups `held`, and what it foresees of them; `kept`: the others.
    ///
    /// # Errors
    /// As [`refit`].
    pub(crate) fn without(&self, kept: &[usize], held: &[usize]) -> Result<FoldFit, ModelError> {
        let part = self.campaign.part(held);
        if let Some(Solved { fit, inputs, there }) = self.by_normal_equations(&part, held) {
            let numbers = self.campaign.averaged_numbers() - part.averaged_numbers();
            let known = KnownInputs::new(inputs, fit.lack_of_fit, numbers, self.parameters.len());
            let foreseen = Predictive::knowing(&fit, known).foreseen_by(there.within(&part), part.clone());
            return Ok(FoldFit { part, foreseen });
        }
        let fit = refit(self.campaign, self.wanted, &self.start, kept)?;
        let foreseen = Predictive::of(&self.campaign.part(kept), &fit)?.foreseen(part.clone())?;
        Ok(FoldFit { part, foreseen })
    }

    /// The fit without a part by the products of everything.
    fn by_normal_equations(&self, part: &Campaign, held: &[usize]) -> Option<Solved> {
        let total = self.total.as_ref()?;
        let own = self.start.equations.own_of(held);
        let products = total - self.products_of(&own, part, held);
        let solution = self.solved(&products)?;
        let (first, last) = (solution.singular_values[0], *solution.singular_values.iter().next_back()?);
        if last < WELL_DETERMINED * first {
            return None;
        }
        let point = self.parameters.moved(&self.start.point, solution.x.as_slice());
        let there = Equations::at(&self.campaign.chosen(held), &point).ok()?;
        self.is_near(&there, &own, &solution).then(|| Solved {
            inputs: self.inputs_after(&products, &solution),
            fit: settled_at(point, self.parameters.clone(), solution),
            there,
        })
    }

    /// What the readings kept tell of the inputs.
    fn inputs_after(&self, products: &DMatrix<f64>, fit: &Solution) -> Option<InputsAfterFit> {
        let p = self.parameters.len();
        let inputs = products.nrows() - p - 1;
        let mut along = products.view((p + 1, 0), (inputs, p + 1)).into_owned();
        let left = along.column(p) - along.columns(0, p) * &fit.x;
        along.set_column(p, &left);
        let squares = products.view((p + 1, p + 1), (inputs, inputs)).into_owned();
        (inputs > 0).then(|| InputsAfterFit::of(&squares, &along)).flatten()
    }

    /// Products of `[A y U]` of a part; of the inputs those at hand, unless none of their errors shows in the part alone.
    fn products_of(&self, own: &DMatrix<f64>, part: &Campaign, held: &[usize]) -> DMatrix<f64> {
        let Some(all) = self.start.equations.inexact() else { return products_beside(own, None) };
        if let Some(inputs) = &part.inexact {
            return products_beside(own, Some((inputs.z(), inputs.products())));
        }
        let u = all.z().select_rows(&rows_of(held.iter().copied()));
        products_beside(own, Some((&u, Cow::Owned(products(&u, &u)))))
    }

    /// The linear fit by the products of everything.
    fn solved(&self, products: &DMatrix<f64>) -> Option<Solution> {
        let p = self.parameters.len();
        let inputs = products.nrows() - p - 1;
        let mut rest = products.view((0, 0), (p + 1, p + 1)).into_owned();
        if inputs > 0 {
            // `B' Z (I + Z' Z)^-1 Z' B` by the factor of the matrix in the middle.
            let of_inputs = products.view((p + 1, p + 1), (inputs, inputs));
            let factor = (of_inputs + DMatrix::identity(inputs, inputs)).cholesky()?;
            let taken = factor.l().solve_lower_triangular(&products.view((p + 1, 0), (inputs, p + 1)))?;
            rest.gemm_tr(-1.0, &taken, &taken, 1.0);
        }
        let sizes = rest.diagonal().map(|x| x.max(f64::MIN_POSITIVE).sqrt());
        let scaled = DMatrix::from_fn(p + 1, p + 1, |i, j| rest[(i, j)] / (sizes[i] * sizes[j]));
        let root = root_of(scaled) * DMatrix::from_diagonal(&sizes);
        let mut triangle = Triangle::new(p);
        triangle.push(&root.columns(0, p).into_owned(), &root.column(p).into_owned()).ok()?;
        push_priors(&mut triangle, &self.start.point, &self.parameters).ok()?;
        triangle.solve().ok()
    }

    /// True when the readings left out are where the linear model has them, and what is foreseen of them is as uncertain as it says.
    fn is_near(&self, there: &Equations, own: &DMatrix<f64>, fit: &Solution) -> bool {
        let p = self.parameters.len();
        let linear = own.column(p) - own.columns(0, p) * &fit.x;
        // A column that nothing hangs on may change as it likes.
        let change = there.own().columns(0, p) - own.columns(0, p);
        let spread = (&change * &fit.covariance).dot(&change);
        let is_within = |squares: f64, limit: f64| squares <= limit * limit * own.nrows() as f64;
        is_within((there.own().column(p) - linear).norm_squared(), NEAR) && is_within(spread, NEAR_IN_SPREAD)
    }
}

/// `K` with `K' K` the products; upper where nothing is without digits.
fn root_of(products: DMatrix<f64>) -> DMatrix<f64> {
    if let Some(factor) = products.clone().cholesky() {
        return factor.unpack().transpose();
    }
    let eigen = products.symmetric_eigen();
    DMatrix::from_diagonal(&eigen.eigenvalues.map(|x| x.max(0.0).sqrt())) * eigen.eigenvectors.transpose()
}

/// Products of all columns of `[B U]`, those of `U` given.
fn products_beside(b: &DMatrix<f64>, inputs: Option<(&DMatrix<f64>, Cow<'_, DMatrix<f64>>)>) -> DMatrix<f64> {
    let Some((u, of_inputs)) = inputs else { return products(b, b) };
    let (m, n) = (b.ncols(), u.ncols());
    let mut all = DMatrix::zeros(m + n, m + n);
    let mixed = products(b, u);
    all.view_mut((0, 0), (m, m)).copy_from(&products(b, b));
    all.view_mut((0, m), (m, n)).copy_from(&mixed);
    all.view_mut((m, 0), (n, m)).copy_from(&mixed.transpose());
    all.view_mut((m, m), (n, n)).copy_from(&of_inputs);
    all
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use hexbench_core::{Matrix6, Measurand};

    use super::*;
    use crate::estimation::fit::fit_baseline;
    use crate::estimation::noise::{Noise, Structure, Symmetric6};
    use crate::estimation::tolerances::within_tolerances;
    use crate::test_machine::readings;

    #[test]
    fn taking_a_pose_off_fits_the_others_whatever_inputs_and_coordinates_have_in_common() {
        let (hexapod, mut data) = readings(Measurand::DeflectionEuler, Vec::new());
        // What the springs leave is of the size of the noise.
        for (i, row) in data.observations.iter_mut().enumerate() {
            row.measured[i % 6] += 8e-8;
        }
        let exact = Campaign::with_noise(&hexapod, &data, Noise::stated(1e-7, 6e-7)).unwrap();
        let within = within_tolerances(exact.clone());
        assert!(within.inexact.is_some() && exact.inexact.is_none());
        let correlated = Matrix6::from_fn(|i, j| if i == j { 1.0 } else { 0.4 });
        let structure = Structure::Axes { covariance: Symmetric6::new(&correlated) };
        let axes = Noise { structure, ..Noise::stated(1e-7, 6e-7) };
        let correlated = Campaign::with_noise(&hexapod, &data, axes).unwrap();
        let (kept, held): (Vec<usize>, Vec<usize>) = (0..9).partition(|g| *g < 6);
        let springs = [exact, within, correlated].map(|campaign| {
            let all = fit_baseline(&campaign).unwrap();
            let folds = FoldFits::from(&campaign, &[], Start::at(&campaign, &[], &all.point).unwrap());
            let taken_off = folds.by_normal_equations(&campaign.part(&held), &held).unwrap().fit;
            let anew = refit(&campaign, &[], &folds.start, &kept).unwrap();
            for leg in 0..6 {
                let off = (taken_off.point.compliances[leg] - anew.point.compliances[leg]) / anew.std(leg);
                assert!(off.abs() < 1e-3, "leg {leg}: {off:.1e}");
                assert!((taken_off.std(leg) / anew.std(leg) - 1.0).abs() < 1e-2);
            }
            (anew.std(0), (anew.point.compliances - all.point.compliances).amax() / anew.std(0))
        });
        assert!(springs[1].0 > 1.05 * springs[0].0, "tolerances widen what is known: {springs:?}");
        assert!(springs.iter().all(|(_, moved)| *moved > 0.05), "the pose left out matters: {springs:?}");
    }

    #[test]
    fn what_is_taken_off_is_the_same_where_no_input_shows_in_the_part_alone() {
        let (hexapod, data) = readings(Measurand::DeflectionEuler, Vec::new());
        let campaign =
            within_tolerances(Campaign::with_noise(&hexapod, &data, Noise::stated(1e-7, 6e-7)).unwrap());
        let folds = FoldFits::from(
            &campaign,
            &[],
            Start::at(&campaign, &[], &fit_baseline(&campaign).unwrap().point).unwrap(),
        );
        let held = [6, 7, 8];
        let (own, shown) = (folds.start.equations.own_of(&held), campaign.part(&held));
        let hidden = Campaign { inexact: None, ..shown.clone() };
        let [shown, hidden] = [shown, hidden].map(|part| folds.products_of(&own, &part, &held));
        assert_eq!(shown, hidden);
    }
}
