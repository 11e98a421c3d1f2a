//! A tall matrix made a triangle once, for any number of right sides.
//!
//! [`Triangle`] reduces `[A y]` strip by strip. What it does to the columns of `A` does not depend on `y`; kept, it leads every further
//! right side to the same triangle, bit by bit, at a small part of the cost.

use std::ops::Range;

use hexbench_core::parallel;
use nalgebra::linalg::QR;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::error::ModelError;
use crate::estimation::lsq::{NOT_FINITE, Solution, Triangle, compensated_residual, one_above_the_other};
use crate::estimation::parallel::strips;

/// A matrix `A`, reduced.
#[derive(Debug, Clone)]
pub(crate) struct Reduced {
    strips: Vec<Strip>,
    /// `A` in place of its rows, with the row that a right side has besides.
    upper: DMatrix<f64>,
    rows: usize,
}

/// What is done to a strip of rows, and then to what came of it below what came of those above.
#[derive(Debug, Clone)]
struct Strip {
    rows: Range<usize>,
    own: Reflections,
    below: Reflections,
}

/// What makes a triangle of rows `[A y]`; none of few rows, which stay as they are.
#[derive(Debug, Clone)]
struct Reflections(Option<QR<f64, Dyn, Dyn>>);

impl Reduced {
    /// Of a matrix.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`].
    pub(crate) fn of(a: &DMatrix<f64>) -> Result<Self, ModelError> {
        refuse_infinite(a.as_slice())?;
        let ranges = strips(a.nrows());
        let is_only = ranges.len() == 1;
        let own = parallel::map(&ranges, |rows| {
            let strip = a.rows(rows.start, rows.len()).into_owned();
            // Of many strips, each becomes a triangle of its own first.
            if is_only { (Reflections(None), strip) } else { Reflections::of(strip) }
        });
        let mut all = Self { strips: Vec::new(), upper: DMatrix::zeros(0, a.ncols()), rows: a.nrows() };
        for (rows, (own, strip)) in ranges.into_iter().zip(own) {
            let (below, upper) = Reflections::of(one_above_the_other(&all.upper, &strip));
            all.upper = upper;
            all.strips.push(Strip { rows, own, below });
        }
        Ok(all)
    }

    /// The triangle that [`Triangle::push`] makes of `[A y]`.
    fn with(&self, y: &DVector<f64>) -> Result<Triangle, ModelError> {
        refuse_infinite(y.as_slice())?;
        let own = |strip: &Strip| strip.own.lead(y.rows(strip.rows.start, strip.rows.len()).into_owned());
        let mut side = DVector::zeros(0);
        for (strip, part) in self.strips.iter().zip(parallel::map(&self.strips, own)) {
            let stack = side.iter().chain(part.iter()).copied().collect();
            side = strip.below.lead(DVector::from_vec(stack));
        }
        let columns = self.upper.ncols();
        let mut r = self.upper.clone().resize_horizontally(columns + 1, 0.0);
        r.set_column(columns, &side);
        Ok(Triangle::of_rows(r, self.rows))
    }

    /// The solution of `min |y - A x|`, `x` refined once on a compensated residual.
    ///
    /// # Errors
    /// As [`Triangle::push`] and [`Triangle::solve`].
    pub(crate) fn refined(&self, a: &DMatrix<f64>, y: &DVector<f64>) -> Result<Solution, ModelError> {
        let mut solution = self.with(y)?.solve()?;
        let residual = compensated_residual(a, y, &solution.x);
        solution.x += self.with(&residual)?.solve()?.x;
        Ok(solution)
    }
}

impl Reflections {
    /// Those of rows of `A`, and the triangle.
    fn of(rows: DMatrix<f64>) -> (Self, DMatrix<f64>) {
        let columns = rows.ncols();
        if rows.nrows() <= columns + 1 {
            return (Self(None), rows);
        }
        let qr = rows.qr();
        let upper = qr.r().resize_vertically(columns + 1, 0.0);
        (Self(Some(qr)), upper)
    }

    /// Leads the right side of the rows along: of what is left of it below the triangle, its length.
    fn lead(&self, mut side: DVector<f64>) -> DVector<f64> {
        let Some(qr) = &self.0 else { return side };
        qr.q_tr_mul(&mut side);
        let columns = qr.qr_internal().ncols();
        let left = side.rows(columns, side.len() - columns).norm();
        let mut upper = side.resize_vertically(columns + 1, 0.0);
        upper[columns] = left;
        upper
    }
}

fn refuse_infinite(numbers: &[f64]) -> Result<(), ModelError> {
    numbers.iter().all(|x| x.is_finite()).then_some(()).ok_or(NOT_FINITE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_right_side_is_led_to_the_triangle_of_both() {
        // No row, few rows, one strip, several, and a last one of few rows.
        for rows in [0, 3, 4, 5, 40, 1536, 1540, 4000] {
            let mut a = DMatrix::from_fn(rows, 3, |i, j| ((1 + i * (j + 2) + 7 * i * i) as f64).sin());
            for is_short in [false, true] {
                if is_short {
                    a.column_mut(1).fill(0.0);
                }
                let reduced = Reduced::of(&a).unwrap();
                for k in 0..2 {
                    let y = DVector::from_fn(rows, |i, _| ((i * i + 5 * k) as f64).cos());
                    let mut both = Triangle::new(3);
                    both.push(&a, &y).unwrap();
                    assert_eq!(reduced.with(&y).unwrap(), both, "{rows} {k}");
                }
            }
        }
        assert!(Reduced::of(&DMatrix::from_element(3, 1, f64::NAN)).is_err());
    }
}
