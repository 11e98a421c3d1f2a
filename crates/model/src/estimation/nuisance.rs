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

use nalgebra::{DMatrix, DVector};

use crate::estimation::parallel::products;

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

/// What readings in hand tell of inputs that a fit has weighed with their tolerances.
pub struct InputsAfterFit {
    /// Expectation of every input, in units of its tolerance.
    pub mean: DVector<f64>,
    /// Covariance of the parameters of the fit, then of the inputs.
    pub covariance: DMatrix<f64>,
}

impl InputsAfterFit {
    /// From the whitened columns of parameters `J` and inputs `Z`, the whitened residuals `r` (inputs not fitted) and the covariance
    /// `K` of the parameters:
    ///
    /// ```text
    /// mean Z' r,   covariance [K, -K A'; -A K, I - Z' Z + A K A'],   A = Z' J
    /// ```
    ///
    /// Whitened by the inputs, too, so that `Z' Z` is below one.
    pub fn of(
        parameters: &DMatrix<f64>,
        inputs: &DMatrix<f64>,
        residuals: &DVector<f64>,
        of_parameters: &DMatrix<f64>,
    ) -> Self {
        let (p, n) = (parameters.ncols(), inputs.ncols());
        let drawn_along = inputs.tr_mul(parameters);
        let cross = -(&drawn_along * of_parameters);
        let own = DMatrix::identity(n, n) - inputs.tr_mul(inputs) - &cross * drawn_along.transpose();
        let mut covariance = DMatrix::zeros(p + n, p + n);
        covariance.view_mut((0, 0), (p, p)).copy_from(of_parameters);
        covariance.view_mut((p, 0), (n, p)).copy_from(&cross);
        covariance.view_mut((0, p), (p, n)).copy_from(&cross.transpose());
        covariance.view_mut((p, p), (n, n)).copy_from(&own);
        Self { mean: inputs.tr_mul(residuals), covariance }
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
    fn inputs_after_a_fit_are_those_of_fitting_everything_together() {
        let (parameters, inputs) = (columns(12, 3, 0.1), columns(12, 5, 0.7));
        let readings = columns(12, 1, 2.0).column(0).into_owned();
        // Together: least squares with the inputs as further parameters, each with a reading of itself.
        let all = both(&parameters, &inputs);
        let mut information = all.tr_mul(&all);
        (3..8).for_each(|k| information[(k, k)] += 1.0);
        let covariance = information.try_inverse().unwrap();
        let together = &covariance * all.tr_mul(&readings);
        // One after the other, whitened.
        let root = weight(&inputs).symmetric_eigen();
        let root = &root.eigenvectors
            * DMatrix::from_diagonal(&root.eigenvalues.map(f64::sqrt))
            * root.eigenvectors.transpose();
        let (j, z) = (&root * &parameters, &root * &inputs);
        let of_parameters = j.tr_mul(&j).try_inverse().unwrap();
        let fitted = &of_parameters * j.tr_mul(&(&root * &readings));
        let after = InputsAfterFit::of(&j, &z, &(&root * &readings - &j * fitted), &of_parameters);
        assert!((after.mean - together.rows(3, 5)).amax() < ROUNDING);
        assert!((after.covariance - covariance).amax() < ROUNDING);
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
