//! Orthonormal bases of many columns, by products of all of them at once instead of one reflection after the other.
//!
//! The Cholesky factor of the products makes columns orthonormal to rounding times the square of their condition; done twice, to
//! rounding (Yamamoto, Nakatsukasa, Yanagisawa and Fukaya 2015, Electronic Transactions on Numerical Analysis 44). Columns are picked
//! by what is left of them beside those picked before; what is too short for the products to tell is looked at again once the others
//! are taken off.

use nalgebra::{DMatrix, DVector};

use crate::estimation::linearization::beside;
use crate::estimation::parallel::products;

/// What is left of a column of unit length below which it depends on the others.
const INDEPENDENT: f64 = 1e-9;
/// The same over the longest, down to which the products tell: their rounding is 1e-14 of its square.
const TOLD: f64 = 1e-5;

/// Orthonormal basis of the columns.
pub fn orthonormal(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let mut rest = columns.clone();
    for mut column in rest.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
        }
    }
    let mut basis = DMatrix::zeros(columns.nrows(), 0);
    loop {
        let (picked, others) = picked(products(&rest, &rest));
        if picked.is_empty() {
            return basis;
        }
        let mut new = upright(rest.select_columns(&picked));
        take_off(&basis, &mut new);
        new = upright(new);
        rest = rest.select_columns(&others);
        for _ in 0..2 {
            take_off(&new, &mut rest);
        }
        basis = beside(&[basis, new]);
    }
}

/// Remove from `y` what lies in the span of an orthonormal basis.
pub fn project(basis: &DMatrix<f64>, y: &mut DVector<f64>) {
    let overlap = basis.tr_mul(y);
    y.gemv(-1.0, basis, &overlap, 1.0);
}

/// The same of many columns.
pub(crate) fn take_off(basis: &DMatrix<f64>, columns: &mut DMatrix<f64>) {
    columns.gemm(-1.0, basis, &products(basis, columns), 1.0);
}

/// Independent columns as their products tell, the longest first, each by what is left of it beside those before; and the others.
fn picked(mut products: DMatrix<f64>) -> (Vec<usize>, Vec<usize>) {
    let (mut picked, mut others) = (Vec::new(), (0..products.ncols()).collect::<Vec<_>>());
    let longest = products.diagonal().iter().copied().fold(0.0, f64::max).sqrt();
    let least = INDEPENDENT.max(TOLD * longest).powi(2);
    loop {
        let longest = others.iter().copied().max_by(|&a, &b| products[(a, a)].total_cmp(&products[(b, b)]));
        let Some(next) = longest.filter(|&k| products[(k, k)] > least) else { return (picked, others) };
        picked.push(next);
        others.retain(|&k| k != next);
        for &j in &others {
            let share = products[(next, j)] / products[(next, next)];
            for &i in &others {
                products[(i, j)] -= products[(i, next)] * share;
            }
        }
    }
}

/// Orthonormal columns of the same span as independent ones.
fn upright(columns: DMatrix<f64>) -> DMatrix<f64> {
    let inverse = products(&columns, &columns).cholesky().and_then(|factor| factor.l().try_inverse());
    match inverse {
        Some(inverse) => columns * inverse.transpose(),
        None => columns.qr().q(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of sums of some hundred products.
    const ROUNDING: f64 = 1e-13;

    #[test]
    fn a_basis_is_orthonormal_and_spans_columns_that_nearly_depend_on_each_other() {
        let wave = |i: usize, k: usize| ((1 + i) as f64 * 0.37 * (1.0 + k as f64).sqrt()).sin();
        let mut columns = DMatrix::from_fn(240, 9, wave);
        // Nearly the first, exactly a sum, and long.
        for (k, off) in [(6, 1e-3), (7, 1e-7)] {
            let near = columns.column(0) + off * columns.column(k);
            columns.set_column(k, &near);
        }
        let sum = columns.column(1) - 3.0 * columns.column(2);
        columns.set_column(8, &sum);
        columns.column_mut(3).scale_mut(1e6);
        let basis = orthonormal(&columns);
        assert_eq!(basis.ncols(), 8);
        let off = (basis.tr_mul(&basis) - DMatrix::identity(8, 8)).amax();
        assert!(off < ROUNDING, "{off:.1e}");
        for column in columns.column_iter() {
            let mut left = column.clone_owned();
            project(&basis, &mut left);
            assert!(left.norm() < INDEPENDENT * column.norm(), "{:.1e}", left.norm() / column.norm());
        }
    }

    #[test]
    fn nothing_spans_nothing() {
        assert_eq!(orthonormal(&DMatrix::zeros(12, 3)).ncols(), 0);
        assert_eq!(orthonormal(&DMatrix::zeros(12, 0)).ncols(), 0);
    }
}
