//! Orthonormal bases of many columns, by products of all of them at once instead of one reflection after the other.
//!
//! The Cholesky factor of the products makes columns orthonormal to rounding times the square of their condition; done twice, to
//! rounding (Yamamoto, Nakatsukasa, Yanagisawa and Fukaya 2015, Electronic Transactions on Numerical Analysis 44). Columns are picked
//! by what is left of them beside those picked before; what is too short for the products to tell is looked at again once the others
//! are taken off.

use nalgebra::{DMatrix, DMatrixView, DMatrixViewMut, DVector};

use crate::estimation::parallel::{products, strips};

/// What is left of a column of unit length below which it depends on the others.
const INDEPENDENT: f64 = 1e-9;
/// The same over the longest, down to which the products tell: their rounding is 1e-14 of its square.
const TOLD: f64 = 1e-5;

/// Orthonormal basis of the columns, in their place.
pub fn orthonormal(mut columns: DMatrix<f64>) -> DMatrix<f64> {
    for mut column in columns.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
        }
    }
    let mut done = 0;
    loop {
        let rest = columns.columns_range(done..);
        let picked = picked(products(rest, rest));
        if picked.is_empty() {
            return columns.resize_horizontally(done, 0.0);
        }
        let all = done + picked.len();
        bring_to_front(&mut columns.columns_range_mut(done..), &picked);
        upright(columns.columns_range_mut(done..all));
        let (basis, mut new) = columns.columns_range_pair_mut(..done, done..all);
        take_off(&basis, &mut new);
        upright(new);
        let (new, mut rest) = columns.columns_range_pair_mut(done..all, all..);
        for _ in 0..2 {
            take_off(&new, &mut rest);
        }
        done = all;
    }
}

/// Remove from `y` what lies in the span of an orthonormal basis.
pub fn project(basis: &DMatrix<f64>, y: &mut DVector<f64>) {
    let overlap = basis.tr_mul(y);
    y.gemv(-1.0, basis, &overlap, 1.0);
}

/// The same of many columns.
pub(crate) fn take_off<'a, 'b>(
    basis: impl Into<DMatrixView<'a, f64>>,
    columns: impl Into<DMatrixViewMut<'b, f64>>,
) {
    let (basis, mut columns) = (basis.into(), columns.into());
    let along = products(basis, columns.as_view());
    columns.gemm(-1.0, &basis, &along, 1.0);
}

/// Independent columns as their products tell, the longest first, each by what is left of it beside those before.
fn picked(mut products: DMatrix<f64>) -> Vec<usize> {
    let (mut picked, mut others) = (Vec::new(), (0..products.ncols()).collect::<Vec<_>>());
    let longest = products.diagonal().iter().copied().fold(0.0, f64::max).sqrt();
    let least = INDEPENDENT.max(TOLD * longest).powi(2);
    loop {
        let longest = others.iter().copied().max_by(|&a, &b| products[(a, a)].total_cmp(&products[(b, b)]));
        let Some(next) = longest.filter(|&k| products[(k, k)] > least) else { return picked };
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

/// Brings the columns of these numbers to the front, in this order.
fn bring_to_front(columns: &mut DMatrixViewMut<'_, f64>, numbers: &[usize]) {
    let mut stands: Vec<usize> = (0..columns.ncols()).collect();
    for (place, number) in numbers.iter().enumerate() {
        let now = stands.iter().position(|n| n == number).unwrap_or(place);
        stands.swap(place, now);
        columns.swap_columns(place, now);
    }
}

/// Makes independent columns orthonormal, of the same span.
fn upright(mut columns: DMatrixViewMut<'_, f64>) {
    let factor = products(columns.as_view(), columns.as_view()).cholesky();
    let Some(inverse) = factor.and_then(|factor| factor.l().try_inverse()) else {
        let upright = columns.clone_owned().qr().q();
        return columns.copy_from(&upright);
    };
    let turned = inverse.transpose();
    for rows in strips(columns.nrows()) {
        let mut strip = columns.rows_mut(rows.start, rows.len());
        let own = &strip * &turned;
        strip.copy_from(&own);
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
        let basis = orthonormal(columns.clone());
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
        assert_eq!(orthonormal(DMatrix::zeros(12, 3)).ncols(), 0);
        assert_eq!(orthonormal(DMatrix::zeros(12, 0)).ncols(), 0);
    }
}
