//! Inputs that are known to a tolerance only, beside the parameters of a plan or a fit.
//!
//! Each input counts in units of its tolerance, so that it is a standard normal variable before anything is read. With `J` the
//! whitened columns of parameters and `Z` those of inputs, all readings together have the information matrix and, inputs
//! unknown, the information of the parameters
//!
//! ```text
//! M = [P C'; C N] = [J Z]' [J Z]         S = P - C' (N + I)^-1 C = J' (I + Z Z')^-1 J
//! trace(G dS) = trace(E dM)              E = [I; -B] G [I; -B]',  B = (N + I)^-1 C
//! ```
//!
//! `M` is a sum over readings, `S` is not: one error of an input is in all of them. Both sides of `S` are Woodbury's identity; the
//! second is how [`whitening`](crate::estimation::whitening) treats readings in hand. A plan whose readings are still chosen adds
//! up `M` and takes `S` of it.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::estimation::parallel::products;
use crate::estimation::tolerances::InputKind;

/// A combination of inputs whose errors move the readings by a smaller squared number of standard deviations does not show: leaving
/// it out changes no standard deviation by more than half of this.
const SHOWS: f64 = 1e-4;

/// Combinations of inputs whose errors show in readings; orthonormal, so that they too are independent standard normal variables.
#[derive(Debug, Clone)]
pub struct ShownInputs {
    /// Squared number of standard deviations by which one of each moves the readings.
    pub squares: Vec<f64>,
    /// Inputs of each, a column per combination.
    pub combinations: DMatrix<f64>,
    /// `Z' Z`, where it was needed to find them.
    pub products: Option<DMatrix<f64>>,
}

impl ShownInputs {
    /// By the columns of the inputs: reading over its standard deviation per tolerance.
    pub fn of(columns: &DMatrix<f64>) -> Self {
        Self::most(columns, columns.ncols())
    }

    /// The same, but only so many: those that move the readings most.
    pub fn most(columns: &DMatrix<f64>, count: usize) -> Self {
        let (readings, inputs) = columns.shape();
        if (1..inputs).contains(&readings) {
            // `Z Z'` is smaller than `Z' Z`, and has the same squares: `U = Z' V s^-1/2`.
            let (squares, vectors) = largest(columns * columns.transpose(), count);
            let mut combinations = columns.tr_mul(&vectors);
            for (mut column, square) in combinations.column_iter_mut().zip(&squares) {
                column /= square.sqrt();
            }
            return Self { squares, combinations, products: None };
        }
        let products = products(columns, columns);
        let (squares, combinations) = largest(products.clone(), count);
        Self { squares, combinations, products: Some(products) }
    }

    /// `K` with which `K K' = U (1 + s)^-1 U'`: what readings leave of the variance of the inputs that show.
    pub fn known(&self) -> DMatrix<f64> {
        let left = self.squares.iter().map(|s| (1.0 + s).sqrt().recip());
        &self.combinations * DMatrix::from_diagonal(&DVector::from_iterator(self.squares.len(), left))
    }
}

/// Eigenvalues that show, at most so many, and their eigenvectors, a column each.
fn largest(products: DMatrix<f64>, count: usize) -> (Vec<f64>, DMatrix<f64>) {
    let eigen = products.symmetric_eigen();
    let mut kept: Vec<usize> =
        (0..eigen.eigenvalues.len()).filter(|&k| eigen.eigenvalues[k] > SHOWS).collect();
    if kept.len() > count {
        kept.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        kept.truncate(count);
    }
    let squares = kept.iter().map(|&k| eigen.eigenvalues[k]).collect();
    (squares, eigen.eigenvectors.select_columns(&kept))
}

/// Information of the first `parameters` of an information matrix when the inputs, which follow them, are known to their
/// tolerances only: `S` of the module.
pub fn marginal(information: &DMatrix<f64>, parameters: usize) -> DMatrix<f64> {
    let own = information.view((0, 0), (parameters, parameters)).into_owned();
    match given_inputs(information, parameters) {
        Some((cross, given)) => own - cross.tr_mul(&given),
        None => own,
    }
}

/// Slope of a function of the [`marginal`] information by the whole one: `E` of the module for a symmetric `slope`, `G`.
pub fn slope_of_whole(information: &DMatrix<f64>, parameters: usize, slope: &DMatrix<f64>) -> DMatrix<f64> {
    let Some((_, given)) = given_inputs(information, parameters) else { return slope.clone() };
    let all = information.nrows();
    let mut spread = DMatrix::zeros(all, parameters);
    spread.view_mut((0, 0), (parameters, parameters)).fill_with_identity();
    spread.rows_mut(parameters, all - parameters).copy_from(&-given);
    &spread * slope * spread.transpose()
}

/// `C` and `(N + I)^-1 C`; none without inputs.
fn given_inputs(information: &DMatrix<f64>, parameters: usize) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let inputs = information.nrows() - parameters;
    if inputs == 0 {
        return None;
    }
    let cross = information.view((parameters, 0), (inputs, parameters)).into_owned();
    let known = information.view((parameters, parameters), (inputs, inputs)).into_owned();
    let factor = (known + DMatrix::identity(inputs, inputs)).cholesky()?;
    let given = factor.solve(&cross);
    Some((cross, given))
}

/// What the readings of a fit tell of inputs that it has weighed with their tolerances.
///
/// With the columns `J` of parameters and `Z` of inputs and the residuals `r` (inputs not fitted), errors of readings independent, and
/// parameters that are `p` away from those fitted:
///
/// ```text
/// inputs = L^-T (L^-1 Z' (r - J p) + e),   e ~ N(0, I),   L L' = I + Z' Z
/// ```
#[derive(Debug, Clone)]
pub struct InputsAfterFit {
    /// `L^-T`.
    root: DMatrix<f64>,
    /// `L^-1 Z' [J r]`.
    told: DMatrix<f64>,
}

impl InputsAfterFit {
    /// From `Z' Z` and `Z' [J r]`; none where they are no numbers.
    pub fn of(products: &DMatrix<f64>, along: &DMatrix<f64>) -> Option<Self> {
        let n = products.nrows();
        let lower = (products + DMatrix::identity(n, n)).cholesky()?.unpack();
        let root = lower.tr_solve_lower_triangular(&DMatrix::identity(n, n))?;
        Some(Self { told: lower.solve_lower_triangular(along)?, root })
    }

    /// True where errors of each kind of inputs are together what their tolerances give in 999 of 1000 cases.
    pub fn is_likely(&self) -> bool {
        const LIKELY: f64 = 0.999;
        let errors = &self.root * self.told.column(self.told.ncols() - 1);
        let of_sensors = InputKind::COLUMNS.min(errors.len())..errors.len();
        let kinds = InputKind::ALL.into_iter().map(InputKind::columns).chain([of_sensors]);
        let is_likely = |kind: Range<usize>| {
            let law = ChiSquared::new(kind.len().max(1) as f64);
            law.is_ok_and(|law| errors.rows_range(kind).norm_squared() <= law.inverse_cdf(LIKELY))
        };
        kinds.filter(|kind| kind.end <= errors.len()).all(is_likely)
    }

    /// Columns of other readings by what stays uncertain of the inputs, `e`, from their columns by the inputs; more of these are other
    /// inputs, of which the fit tells nothing.
    pub fn left(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let known = self.root.nrows().min(columns.ncols());
        let mut left = columns.clone().resize_horizontally(columns.ncols().max(self.root.ncols()), 0.0);
        let product = columns.columns(0, known) * self.root.rows(0, known);
        left.columns_mut(0, product.ncols()).copy_from(&product);
        left
    }

    /// `L' b` as a fit leaves it, by standard deviations of its parameters: the covariance of these is `R R'`.
    pub fn by_deviations(&self, root: &DMatrix<f64>) -> FoundInputs {
        let (slopes, last) = (self.told.columns(0, root.nrows()), self.told.ncols() - 1);
        FoundInputs { mean: self.told.column(last).into_owned(), slope: slopes * root }
    }

    /// What of `[J r]` of other readings the inputs make up, by columns that are [`Self::left`].
    pub fn share_of(&self, left: &DMatrix<f64>) -> DMatrix<f64> {
        left.columns(0, self.told.nrows()) * &self.told
    }
}

/// Inputs `c = L' b` after a fit whose parameters are `x` standard deviations off, in units of what stays uncertain of them:
/// `c = m - M x + e`.
#[derive(Debug, Clone)]
pub struct FoundInputs {
    /// `m`.
    pub mean: DVector<f64>,
    /// `M`.
    pub slope: DMatrix<f64>,
}

impl FoundInputs {
    /// `w` by which the model moves where the inputs are known to be those that another fit to the same readings has found, and its
    /// parameters follow: `x = -M' w`, and what of `c` these do not explain is `w`.
    ///
    /// ```text
    /// w = (I + M M')^-1 (m_other - m)
    /// ```
    pub fn moved_to(&self, other: &Self) -> Option<DVector<f64>> {
        let n = self.mean.len();
        if other.mean.len() != n {
            return None;
        }
        let all = &self.slope * self.slope.transpose() + DMatrix::identity(n, n);
        Some(all.cholesky()?.solve(&(&other.mean - &self.mean)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of sums of some dozen numbers.
    const ROUNDING: f64 = 1e-11;

    fn columns(rows: usize, count: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, count, |i, k| {
            (seed + 1.3 * (i * i) as f64 + 2.7 * (k * k * (i + 1)) as f64).sin()
        })
    }

    fn both(parameters: &DMatrix<f64>, inputs: &DMatrix<f64>) -> DMatrix<f64> {
        crate::estimation::linearization::beside(&[parameters.clone(), inputs.clone()])
    }

    /// `(I + Z Z')^-1`.
    fn weight(inputs: &DMatrix<f64>) -> DMatrix<f64> {
        let n = inputs.nrows();
        (DMatrix::identity(n, n) + inputs * inputs.transpose()).try_inverse().unwrap()
    }

    #[test]
    fn the_marginal_information_is_that_of_readings_with_correlated_errors() {
        let (parameters, inputs) = (columns(12, 3, 0.1), columns(12, 5, 0.7));
        let all = both(&parameters, &inputs);
        let found = marginal(&all.tr_mul(&all), 3);
        let expected = parameters.tr_mul(&(weight(&inputs) * &parameters));
        assert!((found - expected).amax() < ROUNDING);
        let alone = parameters.tr_mul(&parameters);
        assert!(marginal(&alone, 3) == alone, "without inputs nothing changes");
    }

    #[test]
    fn slopes_agree_with_differences() {
        const STEP: f64 = 1e-6;
        let all = both(&columns(12, 3, 0.1), &columns(12, 5, 0.7));
        let more = columns(6, 8, 0.3);
        let (information, added) = (all.tr_mul(&all), more.tr_mul(&more));
        let slope = DMatrix::from_fn(3, 3, |i, j| 1.0 / (1.0 + (i + j) as f64));
        let at = |step: f64| slope.dot(&marginal(&(&information + &added * step), 3));
        let difference = (at(STEP) - at(-STEP)) / (2.0 * STEP);
        let exact = slope_of_whole(&information, 3, &slope).dot(&added);
        assert!((exact - difference).abs() < 1e-7 * exact.abs(), "{exact} {difference}");
    }

    #[test]
    fn readings_are_foreseen_after_a_fit_as_by_fitting_everything_together() {
        let (parameters, inputs) = (columns(12, 3, 0.1), columns(12, 5, 0.7));
        let readings = columns(12, 1, 2.0).column(0).into_owned();
        let others = [columns(4, 3, 0.4), columns(4, 5, 0.9)];
        // Together: least squares with the inputs as further parameters, each with a reading of itself.
        let all = both(&parameters, &inputs);
        let mut information = all.tr_mul(&all);
        (3..8).for_each(|k| information[(k, k)] += 1.0);
        let covariance = information.try_inverse().unwrap();
        let together = &covariance * all.tr_mul(&readings);
        let of_others = both(&others[0], &others[1]);
        // One after the other: the inputs after the parameters.
        let weight = weight(&inputs);
        let of_parameters = (parameters.tr_mul(&weight) * &parameters).try_inverse().unwrap();
        let fitted = &of_parameters * parameters.tr_mul(&weight) * &readings;
        let mut beside = parameters.clone().insert_column(3, 0.0);
        beside.set_column(3, &(&readings - &parameters * &fitted));
        let after = InputsAfterFit::of(&inputs.tr_mul(&inputs), &inputs.tr_mul(&beside)).unwrap();
        let left = after.left(&others[1]);
        let share = after.share_of(&left);
        let mean = &others[0] * &fitted + share.column(3);
        let slope = &others[0] - share.columns(0, 3);
        let spread = &slope * of_parameters * slope.transpose() + &left * left.transpose();
        assert!((mean - &of_others * together).amax() < ROUNDING);
        assert!((spread - &of_others * covariance * of_others.transpose()).amax() < ROUNDING);
    }

    #[test]
    fn readings_have_inputs_that_a_fit_tells_nothing_of_and_lack_others() {
        let inputs = columns(12, 5, 0.7);
        let after =
            InputsAfterFit::of(&inputs.tr_mul(&inputs), &inputs.tr_mul(&columns(12, 2, 0.1))).unwrap();
        let more = columns(4, 7, 0.9);
        let (left, known) = (after.left(&more), after.left(&more.columns(0, 5).into_owned()));
        assert!(left.columns(0, 5) == known && left.columns(5, 2) == more.columns(5, 2));
        assert!(after.share_of(&left) == after.share_of(&known));
        let mut fewer = more.columns(0, 5).into_owned();
        fewer.column_mut(4).fill(0.0);
        let lacking = after.left(&fewer.columns(0, 4).into_owned());
        assert!((lacking - after.left(&fewer)).amax() < ROUNDING);
    }

    #[test]
    fn fewer_readings_than_inputs_show_the_same_inputs() {
        let inputs = columns(4, 7, 0.7);
        let shown = ShownInputs::of(&inputs);
        let u = &shown.combinations;
        assert_eq!((shown.squares.len(), u.shape()), (4, (7, 4)));
        assert!((u.tr_mul(u) - DMatrix::identity(4, 4)).amax() < ROUNDING);
        let squares = DMatrix::from_diagonal(&DVector::from_column_slice(&shown.squares));
        assert!((u * squares * u.transpose() - inputs.tr_mul(&inputs)).amax() < ROUNDING);
    }

    #[test]
    fn inputs_that_do_not_show_are_left_out() {
        let mut inputs = columns(12, 4, 0.7);
        inputs.column_mut(2).fill(0.0);
        let doubled = inputs.column(0) * 2.0;
        inputs.set_column(3, &doubled);
        let shown = ShownInputs::of(&inputs);
        assert_eq!((shown.squares.len(), shown.combinations.ncols()), (2, 2));
    }
}
