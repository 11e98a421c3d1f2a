//! What the residual elongations of the legs follow.
//!
//! For every leg, and all legs together, and every variable `x`, the elongation is regressed on `s x` and `s x^2` beside
//! `s`, where the carrier `s` is 1 (the length changes) or the change of leg force (the compliance changes). The F test
//! of the two added columns gives a chance, multiplied by the number of questions asked (Bonferroni). Spearman's rank
//! correlation of elongation over carrier with the variable tells the direction.
//!
//! The regression is made on the whitened readings, where noise is independent, beside everything the fit has absorbed, so
//! F is exact for Gaussian noise. The questions overlap; the diagnosis weighs effects against each other.

use hexbench_core::statistics::{mean, root_mean_square};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use hexbench_core::Vector6;

use super::JudgedModel;
use super::follows::{Follows, VARIABLES};
use crate::effects::chain::Action;
use crate::estimation::basis::project;
use crate::estimation::campaign::Condition;

/// Associations kept.
const KEPT: usize = 12;
/// Chance after correction below which an association is reported.
const REPORTED: f64 = 0.01;

/// Different values a variable must take before anything can be said to follow it.
const FEWEST_VALUES: usize = 6;

/// A column of which less than this share is left was absorbed by the fit.
const ABSORBED: f64 = 1e-6;

/// A variable that residual elongations follow.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Association {
    /// Leg from 1; absent for all legs together.
    pub leg: Option<usize>,
    /// The variable.
    pub variable: &'static str,
    /// `length` when the elongation itself follows it, `compliance` when elongation per force change does.
    pub of: &'static str,
    /// Spearman's rank correlation.
    pub rank_correlation: f64,
    /// F of the linear and quadratic columns.
    pub f: f64,
    /// Chance by noise, corrected for the number of questions asked.
    pub p: f64,
}

/// Significant associations, most significant first.
pub fn associations(judged: &JudgedModel<'_>) -> Vec<Association> {
    let legs: Vec<Option<usize>> = std::iter::once(None).chain((0..6).map(Some)).collect();
    let mut all = Vec::new();
    for leg in legs {
        for variable in VARIABLES {
            all.extend(
                [false, true]
                    .into_iter()
                    .filter_map(|compliance| question(judged, leg, variable, compliance)),
            );
        }
    }
    let asked = all.len() as f64;
    for a in &mut all {
        a.p = (a.p * asked).min(1.0);
    }
    all.retain(|a| a.p < REPORTED);
    all.sort_by(|a, b| a.p.total_cmp(&b.p).then(b.f.total_cmp(&a.f)));
    all.truncate(KEPT);
    all
}

/// Points of one question: elongation in units of its noise, change of leg force, variable.
struct Points {
    y: Vec<f64>,
    force_change: Vec<f64>,
    x: Vec<f64>,
}

fn points(judged: &JudgedModel<'_>, leg: Option<usize>, value: impl Fn(&Condition, usize) -> f64) -> Points {
    let mut points = Points { y: Vec::new(), force_change: Vec::new(), x: Vec::new() };
    for i in judged.space.determined() {
        let c = &judged.lin.conditions[i];
        for l in (0..6).filter(|l| leg.is_none_or(|only| only == *l)) {
            points.y.push(judged.space.elongation[i][l] / judged.space.sigma[i][l]);
            points.force_change.push(c.force_change()[l]);
            points.x.push(value(c, l));
        }
    }
    points
}

fn question(
    judged: &JudgedModel<'_>,
    leg: Option<usize>,
    variable: Follows,
    compliance: bool,
) -> Option<Association> {
    // Elongation per force change against force change is the same question as elongation against its square.
    if compliance && variable == Follows::ForceChange {
        return None;
    }
    let p = points(judged, leg, |c, l| variable.value(c, l));
    if distinct(&p.x) < FEWEST_VALUES && variable != Follows::Approach {
        return None;
    }
    let (mean, spread) = centre_and_spread(&p.x)?;
    let x = |c: &Condition, l: usize| (variable.value(c, l) - mean) / spread;
    let look = Look { judged, leg, compliance };
    let mut added = vec![look.column(x)];
    if variable != Follows::Approach {
        added.push(look.column(|c, l| x(c, l).powi(2)));
    }
    let (f, p_value) =
        added_columns(judged.white.as_slice(), &[look.column(|_, _| 1.0)], &added, judged.rank)?;
    let sign = |s: &f64| if compliance { s.signum() } else { 1.0 };
    let ratio: Vec<f64> = p.y.iter().zip(&p.force_change).map(|(y, s)| y * sign(s)).collect();
    Some(Association {
        leg: leg.map(|l| l + 1),
        variable: variable.name(),
        of: look.of(),
        rank_correlation: spearman(&ratio, &p.x),
        f,
        p: p_value,
    })
}

/// Word for the carrier that is the change of leg force.
pub(crate) const COMPLIANCE: &str = "compliance";

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

fn distinct(x: &[f64]) -> usize {
    let mut bits: Vec<u64> = x.iter().map(|v| (v + 0.0).to_bits()).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(crate) fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

/// Mean and root mean square deviation; `None` when the values do not vary.
fn centre_and_spread(x: &[f64]) -> Option<(f64, f64)> {
    let mean = mean(x.iter().copied())?;
    let spread = root_mean_square(x.iter().map(|v| v - mean))?;
    let varies = spread > 1e-9 * x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    varies.then_some((mean, spread))
}

/// Spearman's rank correlation, ties sharing their mean rank.
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let centre = |r: &[f64]| r.iter().map(|v| v - f64::midpoint(r.len() as f64, 1.0)).collect::<Vec<_>>();
    let (a, b) = (centre(&a), centre(&b));
    let size = (square(&a) * square(&b)).sqrt();
    if size > 0.0 { dot(&a, &b) / size } else { 0.0 }
}

fn ranks(x: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|&i, &j| x[i].total_cmp(&x[j]));
    let mut ranks = vec![0.0; x.len()];
    let mut first = 0;
    while first < order.len() {
        let same = order[first..].iter().take_while(|&&i| x[i] <= x[order[first]]).count();
        let mean = first as f64 + f64::midpoint(same as f64, 1.0);
        order[first..first + same].iter().for_each(|&i| ranks[i] = mean);
        first += same;
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_correlate_whatever_the_scale() {
        let x: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert!((spearman(&x, &x.map(f64::exp)) - 1.0).abs() < 1e-15);
        assert!((spearman(&x, &x.map(|v| -v)) + 1.0).abs() < 1e-15);
        // By hand: ranks [1, 2.5, 2.5, 4] against [1, 2, 3, 4].
        assert!((spearman(&[1.0, 2.0, 2.0, 3.0], &x[..4]) - 4.5 / 22.5_f64.sqrt()).abs() < 1e-12);
    }

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
