//! How well readings are explained by a scatter from condition to condition, with all that the catalogue could explain fitted beside it.
//!
//! The restricted likelihood (Patterson, Thompson 1971, Biometrika 58) of readings `r` over their noise:
//!
//! ```text
//! r ~ N(0, V + U U' + s B B'),  s -> infinity,   V = I + S S', condition by condition
//! ln L = -(ln |V| + ln |P + N| + r' V^-1 r - c' (P + N)^-1 c) / 2,   N = C' V^-1 C,  c = C' V^-1 r,  C = [B U],  P = diag(0, 1)
//! ```
//!
//! with the columns `B` of the catalogue, `U` of inputs that are known to a tolerance, and what scatters, `S`.

use hexbench_core::streams::{Purpose, stream};
use nalgebra::{DMatrix, DVector, Matrix6};
use rand::seq::index::sample;

use super::remainder::Remainder;
use crate::estimation::basis::orthonormal;
use crate::estimation::campaign::rows_of;
use crate::estimation::linearization::beside;
use crate::estimation::parallel::products;
use crate::inference::candidates::target;

/// Conditions that are looked at, at most.
const MOST: usize = 200;

/// Some of the conditions of readings, beside what is fitted to all.
pub(super) struct Restricted {
    conditions: Vec<usize>,
    all: usize,
    /// `[B U r]`, six rows for each condition.
    columns: DMatrix<f64>,
    /// Diagonal of `P`.
    priors: DVector<f64>,
}

impl Restricted {
    pub(super) fn of(rest: &Remainder<'_>) -> Self {
        let all = rest.campaign.groups.len();
        let conditions = drawn_from(all);
        let rows = rows_of(conditions.iter().copied());
        let read = target(rest.lin, rest.point).select_rows(&rows);
        let read = DMatrix::from_column_slice(read.len(), 1, read.as_slice());
        // At some of the conditions, some of its columns may be none of their own.
        let basis = orthonormal(rest.basis.select_rows(&rows));
        let (fitted, known) = (basis.ncols(), rest.inputs.ncols());
        let columns = beside(&[basis, rest.inputs.select_rows(&rows), read]);
        let priors = DVector::from_fn(fitted + known, |k, _| f64::from(u8::from(k >= fitted)));
        Self { conditions, all, columns, priors }
    }

    /// Logarithm of the likelihood, up to a constant, when every condition scatters like this over its noise; none where too few are looked
    /// at for all that is fitted.
    pub(super) fn evidence(&self, scatter: impl Fn(usize) -> Matrix6<f64>) -> Option<f64> {
        let mut white = self.columns.clone();
        let mut log_det = 0.0;
        for (i, &g) in self.conditions.iter().enumerate() {
            let s = scatter(g);
            let lower = (Matrix6::identity() + s * s.transpose()).cholesky()?.l();
            log_det += 2.0 * lower.diagonal().iter().map(|x| x.ln()).sum::<f64>();
            lower.solve_lower_triangular_mut(&mut white.fixed_rows_mut::<6>(6 * i));
        }
        let normal = products(&white, &white);
        let p = self.priors.len();
        let inner = normal.view((0, 0), (p, p)) + DMatrix::from_diagonal(&self.priors);
        let factor = inner.cholesky()?;
        log_det += factor.ln_determinant();
        let along = normal.view((0, p), (p, 1)).column(0).into_owned();
        Some(-0.5 * (log_det + normal[(p, p)] - along.dot(&factor.solve(&along)))).filter(|x| x.is_finite())
    }

    /// A difference of these likelihoods, as all conditions would have it.
    pub(super) fn of_all(&self, difference: f64) -> f64 {
        difference * self.all as f64 / self.conditions.len().max(1) as f64
    }
}

/// Some of so many conditions, drawn: every so many would be in step with the plan, in which loads come round at every pose.
fn drawn_from(all: usize) -> Vec<usize> {
    let mut rng = stream(0, Purpose::ComparedConditions, []);
    let mut some = sample(&mut rng, all, MOST.min(all)).into_vec();
    some.sort_unstable();
    some
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;

    /// A number that looks drawn, between -1 and 1.
    fn number(i: usize, k: usize) -> f64 {
        ((i * 7 + k * 13 + i * i * 3 + k * k * 5) % 31) as f64 / 15.0 - 1.0
    }

    /// By the whole covariance, in which what is fitted has a large variance.
    fn in_full(all: &Restricted, fitted: usize, scatter: impl Fn(usize) -> Matrix6<f64>) -> f64 {
        const LARGE: f64 = 1e7;
        let n = all.columns.nrows();
        let mut covariance = DMatrix::identity(n, n);
        for (i, &g) in all.conditions.iter().enumerate() {
            let s = scatter(g);
            let mut own = covariance.fixed_view_mut::<6, 6>(6 * i, 6 * i);
            own += s * s.transpose();
        }
        for k in 0..all.priors.len() {
            let column = all.columns.column(k);
            covariance += column * column.transpose() * if k < fitted { LARGE } else { 1.0 };
        }
        let read = all.columns.column(all.priors.len()).into_owned();
        let factor = covariance.cholesky().unwrap();
        let log_det: f64 = factor.ln_determinant();
        -0.5 * (log_det + read.dot(&factor.solve(&read)))
    }

    #[test]
    fn likelihoods_differ_as_those_of_the_whole_covariance_do() {
        let (fitted, known) = (4, 2);
        let all = Restricted {
            conditions: vec![0, 2, 4],
            all: 6,
            columns: DMatrix::from_fn(18, fitted + known + 1, number),
            priors: DVector::from_fn(fitted + known, |k, _| f64::from(u8::from(k >= fitted))),
        };
        let of = |size: f64| move |g: usize| Matrix6::from_fn(|i, k| size * number(i + g, k));
        let [small, large] = [0.3, 2.0].map(|size| all.evidence(of(size)).unwrap());
        let [small_in_full, large_in_full] = [0.3, 2.0].map(|size| in_full(&all, fitted, of(size)));
        let (found, expected) = (large - small, large_in_full - small_in_full);
        assert!(
            expected.abs() > 1.0 && (found - expected).abs() < 1e-3 * expected.abs(),
            "{found} {expected}"
        );
        assert!((all.of_all(1.5) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn conditions_looked_at_have_every_load_of_a_plan() {
        assert_eq!(drawn_from(5), [0, 1, 2, 3, 4]);
        for (all, loads) in [(1_200, 6), (10_000, 8), (4_800, 12)] {
            let some = drawn_from(all);
            assert_eq!(some.len(), MOST);
            for load in 0..loads {
                let of_load = some.iter().filter(|&&g| g % loads == load).count();
                assert!(3 * of_load * loads > MOST, "{of_load} of {load} in {all}");
            }
        }
    }
}
