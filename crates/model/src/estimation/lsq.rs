//! Linear least squares in whitened units: streaming QR, rank, minimum norm, covariance.
//!
//! Minimizes `|y - A x|^2` for tall `A` given in pieces: `[A y]` is folded into an upper triangle (Golub and
//! Van Loan, Matrix Computations, 4th ed., 5.3 and 12.2). Columns are scaled to unit length before the singular
//! value decomposition of the triangle, so rank does not depend on the units of the parameters.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::error::ModelError;
use crate::estimation::parallel::{strips, try_take_in_order};
use crate::estimation::reduced::Reduced;

/// Singular values below this fraction of the largest, after scaling the columns, count as zero.
pub const RANK_TOLERANCE: f64 = 1e-10;

/// What a matrix with a number that is none ends in.
pub(crate) const NOT_FINITE: ModelError = ModelError::NotFinite { what: "the regressor" };

/// Sweeps after which a singular value decomposition is given up.
const MOST_SWEEPS: usize = 10_000;
/// Halvings of the interval in which the damping of a shortened step lies.
const DAMPING_HALVINGS: usize = 200;
/// Length of such a step over the radius: near enough.
const NEARLY: f64 = 0.9;

/// Upper triangle `R` and `Q'y` of all rows seen so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    columns: usize,
    r: DMatrix<f64>,
    rows: usize,
}

impl Triangle {
    /// No rows yet; `columns` unknowns.
    pub fn new(columns: usize) -> Self {
        Self { columns, r: DMatrix::zeros(0, columns + 1), rows: 0 }
    }

    /// Of so many rows `[A y]`, made a triangle already.
    pub(crate) fn of_rows(r: DMatrix<f64>, rows: usize) -> Self {
        Self { columns: r.ncols() - 1, r, rows }
    }

    /// Fold in rows: `a` (n x columns) and `y` (n).
    ///
    /// # Errors
    /// [`ModelError::NotFinite`], checked before any linear algebra.
    pub fn push(&mut self, a: &DMatrix<f64>, y: &DVector<f64>) -> Result<(), ModelError> {
        let columns = self.columns;
        self.push_strips(a.nrows(), |rows| {
            let mut strip = DMatrix::zeros(rows.len(), columns + 1);
            strip.columns_mut(0, columns).copy_from(&a.rows(rows.start, rows.len()));
            strip.column_mut(columns).copy_from(&y.rows(rows.start, rows.len()));
            strip
        })
    }

    /// Fold in so many rows `[a y]`, made strip by strip on all cores; the same bytes on any number of them.
    ///
    /// # Errors
    /// As [`Self::push`].
    pub(crate) fn push_strips(
        &mut self,
        rows: usize,
        strip: impl Fn(Range<usize>) -> DMatrix<f64> + Sync,
    ) -> Result<(), ModelError> {
        let strips = strips(rows);
        let is_only = strips.len() == 1;
        let mut folded = self.r.clone();
        let own = |range: &Range<usize>| {
            let strip = strip(range.clone());
            if !strip.as_slice().iter().all(|x| x.is_finite()) {
                return Err(NOT_FINITE);
            }
            // Of many strips, each becomes a triangle of its own first.
            Ok(if is_only { strip } else { upper(strip) })
        };
        try_take_in_order(&strips, own, |strip| folded = upper(one_above_the_other(&folded, &strip)))?;
        self.r = folded;
        self.rows += rows;
        Ok(())
    }

    /// The same with some unknowns held at zero.
    #[must_use]
    pub fn without(&self, held: &[usize]) -> Self {
        let mut free = self.clone();
        for &k in held {
            free.r.column_mut(k).fill(0.0);
        }
        free
    }

    /// Number of rows folded in.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sum of squared residuals `|y - A x|^2` of all rows.
    pub fn misfit(&self, x: &DVector<f64>) -> f64 {
        (self.r.column(self.columns) - self.r.columns(0, self.columns) * x).norm_squared()
    }

    /// The same of no step: `|y|^2`.
    pub(crate) fn misfit_at_zero(&self) -> f64 {
        self.r.column(self.columns).norm_squared()
    }

    /// The best `x` with `|D x|` just within a radius that the solution exceeds: `(A'A + lambda D^2) x = A'y`, `D` a scale for each
    /// column.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] when the decomposition fails.
    pub fn within(&self, scale: &DVector<f64>, radius: f64) -> Result<DVector<f64>, ModelError> {
        let scaled = DMatrix::from_fn(self.r.nrows(), self.columns, |i, j| self.r[(i, j)] / scale[j]);
        let (u, s, v_t) = decomposed(scaled)?;
        let load = u.tr_mul(&self.r.column(self.columns));
        let damped =
            |lambda: f64| load.zip_map(&s, |l, s| if s > 0.0 { l * s / (s * s + lambda) } else { 0.0 });
        // Longer than the radius at the lower end, shorter at the upper one.
        let (mut low, mut high) = (0.0, load.component_mul(&s).norm() / radius);
        for _ in 0..DAMPING_HALVINGS {
            let middle = f64::midpoint(low, high);
            let length = damped(middle).norm();
            if length > radius {
                low = middle;
            } else {
                high = middle;
            }
            if length <= radius && length > NEARLY * radius {
                break;
            }
        }
        Ok(v_t.tr_mul(&damped(high)).component_div(scale))
    }

    /// Solve, with the minimum-norm solution (in scaled columns) where the rows do not determine the unknowns.
    ///
    /// # Errors
    /// [`ModelError::TooFewEquations`] without any row, [`ModelError::NotFinite`] when the decomposition fails.
    pub fn solve(&self) -> Result<Solution, ModelError> {
        let n = self.columns;
        if self.rows == 0 || n == 0 {
            return Err(ModelError::TooFewEquations { equations: self.rows, unknowns: n });
        }
        let r = self.r.columns(0, n).into_owned();
        let z = self.r.column(n).into_owned();
        let scale =
            DVector::from_fn(n, |j, _| if r.column(j).norm() > 0.0 { r.column(j).norm() } else { 1.0 });
        let scaled = DMatrix::from_fn(r.nrows(), n, |i, j| r[(i, j)] / scale[j]);
        let parts = match by_substitution(&scaled, &z) {
            Some(parts) => parts,
            None => by_singular_vectors(&scaled, &z)?,
        };
        Ok(parts.in_units(&scaled, &z, scale))
    }
}

/// The triangle that a matrix has in place of its rows; few rows stay as they are.
fn upper(rows: DMatrix<f64>) -> DMatrix<f64> {
    if rows.nrows() > rows.ncols() { rows.qr().unpack_r() } else { rows }
}

pub(crate) fn one_above_the_other(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let mut stack = DMatrix::zeros(above.nrows() + below.nrows(), below.ncols());
    stack.rows_mut(0, above.nrows()).copy_from(above);
    stack.rows_mut(above.nrows(), below.nrows()).copy_from(below);
    stack
}

/// `U`, the singular values and `V'`.
type Factors = (DMatrix<f64>, DVector<f64>, DMatrix<f64>);

/// Factors of a matrix.
fn decomposed(matrix: DMatrix<f64>) -> Result<Factors, ModelError> {
    let failed = ModelError::NotFinite { what: "the singular value decomposition" };
    let svd = matrix.try_svd(true, true, f64::EPSILON, MOST_SWEEPS);
    svd.and_then(|svd| Some((svd.u?, svd.singular_values, svd.v_t?))).ok_or(failed)
}

/// Solution of a least-squares problem with everything needed to judge it.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Parameters.
    pub x: DVector<f64>,
    /// Inverse of `A'A` on the determined subspace: the covariance in whitened units.
    pub covariance: DMatrix<f64>,
    /// Sum of squared residuals.
    pub rss: f64,
    /// Number of determined combinations.
    pub rank: usize,
    /// Singular values of the column-scaled matrix, largest first.
    pub singular_values: DVector<f64>,
    /// Undetermined combinations: orthonormal columns in scaled parameters (unit-norm columns of `A`).
    pub null_space: DMatrix<f64>,
    /// Norms of the columns of `A`.
    pub column_norms: DVector<f64>,
}

impl Solution {
    /// Condition number of the column-scaled matrix; infinite when rank-deficient.
    pub fn condition(&self) -> f64 {
        let s = &self.singular_values;
        if self.rank < s.len() { f64::INFINITY } else { s[0] / s[s.len() - 1] }
    }

    /// Share of a parameter that lies in the undetermined combinations, 0 to 1.
    pub fn undetermined_share(&self, parameter: usize) -> f64 {
        self.null_space.row(parameter).norm()
    }
}

/// A solution in scaled columns.
struct Parts {
    x: DVector<f64>,
    covariance: DMatrix<f64>,
    rank: usize,
    /// Largest first.
    singular_values: DVector<f64>,
    null_space: DMatrix<f64>,
}

impl Parts {
    /// In the units of the columns, which are `scale` times as long.
    fn in_units(self, scaled: &DMatrix<f64>, z: &DVector<f64>, scale: DVector<f64>) -> Solution {
        let Self { x, covariance, rank, singular_values, null_space } = self;
        let rss = (z - scaled * &x).norm_squared();
        let unscale = |i: usize| 1.0 / scale[i];
        let n = scale.len();
        Solution {
            x: DVector::from_fn(n, |i, _| x[i] * unscale(i)),
            covariance: DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] * unscale(i) * unscale(j)),
            rss,
            rank,
            singular_values,
            null_space,
            column_norms: scale,
        }
    }
}

/// By substitution, which takes a small part of the time of singular vectors; none where the matrix is no triangle, or the rows do not
/// determine all unknowns.
fn by_substitution(scaled: &DMatrix<f64>, z: &DVector<f64>) -> Option<Parts> {
    let n = scaled.ncols();
    let is_upper = |j: usize| scaled.column(j).rows_range(j + 1..).iter().all(|below| *below == 0.0);
    if scaled.nrows() < n || !(0..n).all(is_upper) {
        return None;
    }
    let r = scaled.rows(0, n).into_owned();
    // A column that is held at zero.
    if r.diagonal().iter().any(|x| *x == 0.0) {
        return None;
    }
    let singular_values = r.clone().try_svd(false, false, f64::EPSILON, MOST_SWEEPS)?.singular_values;
    if singular_values.min() <= RANK_TOLERANCE * singular_values.max() {
        return None;
    }
    let inverse = r.solve_upper_triangular(&DMatrix::identity(n, n))?;
    Some(Parts {
        x: r.solve_upper_triangular(&z.rows(0, n))?,
        covariance: &inverse * inverse.transpose(),
        rank: n,
        singular_values,
        null_space: DMatrix::zeros(n, 0),
    })
}

/// By singular vectors, with the minimum norm.
fn by_singular_vectors(scaled: &DMatrix<f64>, z: &DVector<f64>) -> Result<Parts, ModelError> {
    let n = scaled.ncols();
    let (u, s, v_t) = decomposed(scaled.clone())?;
    let mut order: Vec<usize> = (0..s.len()).collect();
    order.sort_by(|&i, &j| s[j].total_cmp(&s[i]));
    let cut = RANK_TOLERANCE * s.max();
    let determined: Vec<usize> = order.iter().copied().filter(|&k| s[k] > cut).collect();
    let (mut x, mut covariance) = (DVector::zeros(n), DMatrix::zeros(n, n));
    for &k in &determined {
        let v = v_t.row(k).transpose();
        x += &v * (u.column(k).dot(z) / s[k]);
        covariance += &v * v.transpose() / (s[k] * s[k]);
    }
    Ok(Parts {
        x,
        covariance,
        rank: determined.len(),
        singular_values: DVector::from_fn(n, |i, _| order.get(i).map_or(0.0, |&k| s[k])),
        null_space: null_space(&v_t, &determined, n),
    })
}

/// Orthonormal complement of the determined right singular vectors (also when there are fewer rows than columns).
fn null_space(v_t: &DMatrix<f64>, determined: &[usize], n: usize) -> DMatrix<f64> {
    let mut basis: Vec<DVector<f64>> = determined.iter().map(|&k| v_t.row(k).transpose()).collect();
    let known = basis.len();
    for axis in 0..n {
        if basis.len() == n {
            break;
        }
        let mut e = DVector::zeros(n);
        e[axis] = 1.0;
        for _ in 0..2 {
            for b in &basis {
                e -= b * b.dot(&e);
            }
        }
        if e.norm() > 1e-6 {
            basis.push(e.normalize());
        }
    }
    DMatrix::from_fn(n, basis.len() - known, |i, j| basis[known + j][i])
}

/// Solve `min |y - A x|` for a matrix in memory, with one step of refinement on a compensated residual.
///
/// # Errors
/// As [`Triangle::push`] and [`Triangle::solve`].
pub fn solve(a: &DMatrix<f64>, y: &DVector<f64>) -> Result<Solution, ModelError> {
    let mut solution = Reduced::of(a)?.refined(a, y)?;
    solution.rss = compensated_residual(a, y, &solution.x).norm_squared();
    Ok(solution)
}

/// `y - A x`, every element accumulated in twice the working precision (Ogita, Rump and Oishi 2005, Dot2).
pub(crate) fn compensated_residual(a: &DMatrix<f64>, y: &DVector<f64>, x: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(y.len(), |i, _| {
        let (mut sum, mut error) = (y[i], 0.0);
        for j in 0..x.len() {
            let product = -a[(i, j)] * x[j];
            let product_error = (-a[(i, j)]).mul_add(x[j], -product);
            let next = sum + product;
            let back = next - sum;
            error += (sum - (next - back)) + (product - back) + product_error;
            sum = next;
        }
        sum + error
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    /// A triangle of seven columns; the sixth is `alike` of the fifth.
    fn triangle(alike: f64) -> DMatrix<f64> {
        let mut r = DMatrix::from_fn(8, 7, |i, j| {
            if i > j {
                0.0
            } else {
                (1.3 * i as f64 + 0.7 * (j * j) as f64).sin() + f64::from(u8::from(i == j))
            }
        });
        let (fifth, sixth) = (r.column(4).into_owned(), r.column(5).into_owned());
        r.set_column(5, &(fifth * alike + sixth * (1.0 - alike)));
        r
    }

    #[test]
    fn substitution_gives_what_singular_vectors_give() {
        let z = DVector::from_fn(8, |i, _| (2.1 * i as f64).cos());
        for alike in [0.0, 0.9, 1.0 - 1e-6] {
            let r = triangle(alike);
            let (fast, full) = (by_substitution(&r, &z).unwrap(), by_singular_vectors(&r, &z).unwrap());
            let limit = 1e-13 * full.singular_values[0] / full.singular_values[6];
            assert_eq!((fast.rank, fast.null_space.ncols()), (7, full.null_space.ncols()));
            assert!((&fast.x - &full.x).norm() < limit * full.x.norm(), "{alike}");
            assert!((&fast.covariance - &full.covariance).norm() < limit * full.covariance.norm(), "{alike}");
            assert!((&fast.singular_values - &full.singular_values).norm() < 1e-13, "{alike}");
        }
    }

    #[test]
    fn what_is_no_triangle_or_leaves_unknowns_open_takes_singular_vectors() {
        let z = DVector::from_element(8, 1.0);
        assert!(by_substitution(&triangle(1.0 - 1e-12), &z).is_none());
        let mut full = triangle(0.0);
        full[(7, 2)] = 0.1;
        assert!(by_substitution(&full, &z).is_none());
        let few = triangle(0.0).rows(0, 6).into_owned();
        assert!(by_substitution(&few, &DVector::from_element(6, 1.0)).is_none());
    }
}
