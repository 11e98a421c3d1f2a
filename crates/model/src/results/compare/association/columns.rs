//! The tests column by column: for errors of readings that are correlated, and to check the sums.

use hexbench_core::Vector6;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::COMPLIANCE;
use crate::effects::chain::Action;
use crate::estimation::basis::project;
use crate::estimation::campaign::Condition;
use crate::results::compare::JudgedModel;

/// A column of which less than this share is left was absorbed by the fit.
const ABSORBED: f64 = 1e-6;

/// One way to look at the residuals: which legs, and whether their length or their compliance is asked about.
pub(crate) struct Look<'a> {
    pub(crate) judged: &'a JudgedModel<'a>,
    pub(crate) leg: Option<usize>,
    pub(crate) compliance: bool,
}

impl Look<'_> {
    /// Whitened readings that an elongation `carrier * course` of the legs would give, less what the fit absorbs.
    pub(crate) fn column(&self, course: impl Fn(&Condition, usize) -> f64) -> Vec<f64> {
        let elongation = |c: &Condition| {
            let one = |l: usize, _| {
                let carrier = if self.compliance { c.force_change()[l] } else { 1.0 };
                if self.leg.is_none_or(|only| only == l) { carrier * course(c, l) } else { 0.0 }
            };
            Action::Elongation(Vector6::from_fn(one))
        };
        let block = self.judged.lin.block_of(1, |c, out| out.push(elongation(c)));
        let mut column = block.column(0).into_owned();
        let before = column.norm();
        project(&self.judged.basis, &mut column);
        // What the fit absorbs altogether leaves rounding only.
        if column.norm() < ABSORBED * before {
            column.fill(0.0);
        }
        column.as_slice().to_vec()
    }

    /// Word for files.
    pub(crate) fn of(&self) -> &'static str {
        if self.compliance { COMPLIANCE } else { "length" }
    }
}

/// F and its chance for columns added to a regression; `lost` degrees of freedom went into the fit before.
pub(crate) fn added_columns(
    y: &[f64],
    base: &[Vec<f64>],
    added: &[Vec<f64>],
    lost: f64,
) -> Option<(f64, f64)> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut residual = y.to_vec();
    for c in base {
        take(&mut basis, c, &mut residual);
    }
    let (before, known) = (square(&residual), basis.len());
    for c in added {
        take(&mut basis, c, &mut residual);
    }
    let gained = (basis.len() - known) as f64;
    let dof = y.len() as f64 - basis.len() as f64 - lost;
    let after = square(&residual);
    if gained < 1.0 || dof < 3.0 || after <= 0.0 {
        return None;
    }
    let f = (before - after).max(0.0) / gained / (after / dof);
    let law = FisherSnedecor::new(gained, dof).ok().filter(|_| f.is_finite())?;
    Some((f, law.sf(f)))
}

/// Orthonormalize a column against the basis, and take its share out of `y` (Gram-Schmidt, twice).
fn take(basis: &mut Vec<Vec<f64>>, column: &[f64], y: &mut [f64]) {
    let size = square(column).sqrt();
    let mut c = column.to_vec();
    for _ in 0..2 {
        for b in basis.iter() {
            let share = dot(&c, b);
            subtract(&mut c, b, share);
        }
    }
    let rest = square(&c).sqrt();
    if rest <= 1e-9 * size || rest == 0.0 {
        return;
    }
    for v in &mut c {
        *v /= rest;
    }
    let share = dot(y, &c);
    subtract(y, &c, share);
    basis.push(c);
}

fn subtract(from: &mut [f64], what: &[f64], times: f64) {
    from.iter_mut().zip(what).for_each(|(a, b)| *a -= times * b);
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_f_test_of_an_added_column_meets_the_closed_form() {
        let x: Vec<f64> = (0..10).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|v| 2.0 * v + (v * 1.7).sin()).collect();
        let ones = vec![1.0; 10];
        let (f, p) = added_columns(&y, &[ones], std::slice::from_ref(&x), 0.0).unwrap();
        let (mx, my) = (4.5, y.iter().sum::<f64>() / 10.0);
        let sxy: f64 = x.iter().zip(&y).map(|(a, b)| (a - mx) * (b - my)).sum();
        let (sxx, syy): (f64, f64) =
            (x.iter().map(|a| (a - mx).powi(2)).sum(), y.iter().map(|b| (b - my).powi(2)).sum());
        let r2 = sxy * sxy / (sxx * syy);
        assert!((f / (r2 / (1.0 - r2) * 8.0) - 1.0).abs() < 1e-9);
        assert!(p < 1e-8);
    }
}
