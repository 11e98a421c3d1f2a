//! What the residual elongations of the legs follow.
//!
//! For every leg, and all legs together, and every variable `x`, the elongation is regressed on `s x` and `s x^2` beside
//! `s`, where the carrier `s` is 1 (the length changes) or the change of leg force (the compliance changes). The F test
//! of the two added columns gives a chance, multiplied by the number of questions asked (Bonferroni). Spearman's rank
//! correlation of elongation over carrier with the variable tells the direction.
//!
//! Limits: residuals of a fit are slightly correlated with each other and with the columns fitted, so chances are a guide;
//! the diagnosis weighs effects properly.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::Judged;
use crate::campaign::Condition;

/// Associations kept.
const KEPT: usize = 12;
/// Chance after correction below which an association is reported.
const REPORTED: f64 = 0.01;

/// What an elongation may follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Follows {
    Force,
    ForceChange,
    Length,
    Elapsed,
    DeltaT,
    Approach,
    Pose(usize),
}

const VARIABLES: [Follows; 12] = [
    Follows::Force,
    Follows::ForceChange,
    Follows::Length,
    Follows::Elapsed,
    Follows::DeltaT,
    Follows::Approach,
    Follows::Pose(0),
    Follows::Pose(1),
    Follows::Pose(2),
    Follows::Pose(3),
    Follows::Pose(4),
    Follows::Pose(5),
];

impl Follows {
    fn name(self) -> &'static str {
        match self {
            Self::Force => "leg_force",
            Self::ForceChange => "leg_force_change",
            Self::Length => "leg_length",
            Self::Elapsed => "elapsed_s",
            Self::DeltaT => "delta_T_K",
            Self::Approach => "approach",
            Self::Pose(k) => ["a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg"][k],
        }
    }

    fn value(self, c: &Condition, leg: usize) -> f64 {
        match self {
            Self::Force => c.force[leg],
            Self::ForceChange => c.force_change()[leg],
            Self::Length => c.extension[leg],
            Self::Elapsed => c.elapsed,
            Self::DeltaT => c.delta_t,
            Self::Approach => c.approach,
            Self::Pose(k) => c.pose.to_array()[k],
        }
    }
}

/// A variable that residual elongations follow.
#[derive(Debug, Clone, Serialize)]
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
pub fn associations(judged: &Judged<'_>) -> Vec<Association> {
    let legs: Vec<Option<usize>> = std::iter::once(None).chain((0..6).map(Some)).collect();
    let mut all = Vec::new();
    for leg in legs {
        for variable in VARIABLES {
            all.extend([false, true].into_iter().filter_map(|compliance| question(judged, leg, variable, compliance)));
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

/// Points of one question, whitened: elongation, carrier, variable.
pub(crate) struct Points {
    pub(crate) y: Vec<f64>,
    pub(crate) carrier: Vec<f64>,
    pub(crate) x: Vec<f64>,
}

pub(crate) fn points(
    judged: &Judged<'_>,
    leg: Option<usize>,
    compliance: bool,
    value: impl Fn(&Condition, usize) -> f64,
) -> Points {
    let mut points = Points { y: Vec::new(), carrier: Vec::new(), x: Vec::new() };
    for (i, c) in judged.lin.conditions.iter().enumerate() {
        for l in (0..6).filter(|l| leg.is_none_or(|only| only == *l)) {
            let sigma = judged.space.sigma[i][l];
            points.y.push(judged.space.elongation[i][l] / sigma);
            points.carrier.push(if compliance { c.force_change()[l] } else { 1.0 } / sigma);
            points.x.push(value(c, l));
        }
    }
    points
}

fn question(judged: &Judged<'_>, leg: Option<usize>, variable: Follows, compliance: bool) -> Option<Association> {
    // Elongation per force change against force change is the same question as elongation against its square.
    if compliance && variable == Follows::ForceChange {
        return None;
    }
    let p = points(judged, leg, compliance, |c, l| variable.value(c, l));
    let x = standardised(&p.x)?;
    let base = vec![p.carrier.clone()];
    let linear: Vec<f64> = p.carrier.iter().zip(&x).map(|(s, x)| s * x).collect();
    let square: Vec<f64> = p.carrier.iter().zip(&x).map(|(s, x)| s * x * x).collect();
    let two_valued = variable == Follows::Approach;
    let added = if two_valued { vec![linear] } else { vec![linear, square] };
    let (f, p_value) = added_columns(&p.y, &base, &added)?;
    let ratio: Vec<f64> = p.y.iter().zip(&p.carrier).map(|(y, s)| y * s.signum()).collect();
    Some(Association {
        leg: leg.map(|l| l + 1),
        variable: variable.name(),
        of: if compliance { "compliance" } else { "length" },
        rank_correlation: spearman(&ratio, &p.x),
        f,
        p: p_value,
    })
}

/// F and its chance for columns added to a regression.
pub(crate) fn added_columns(y: &[f64], base: &[Vec<f64>], added: &[Vec<f64>]) -> Option<(f64, f64)> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut residual = y.to_vec();
    base.iter().for_each(|c| take(&mut basis, c, &mut residual));
    let (before, known) = (square(&residual), basis.len());
    added.iter().for_each(|c| take(&mut basis, c, &mut residual));
    let gained = (basis.len() - known) as f64;
    let dof = y.len() as f64 - basis.len() as f64;
    let after = square(&residual);
    if gained < 1.0 || dof < 3.0 || after <= 0.0 {
        return None;
    }
    let f = (before - after).max(0.0) / gained / (after / dof);
    let law = FisherSnedecor::new(gained, dof).ok().filter(|_| f.is_finite())?;
    Some((f, law.sf(f)))
}

/// Orthonormalise a column against the basis, and take its share out of `y` (Gram-Schmidt, twice).
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
    c.iter_mut().for_each(|v| *v /= rest);
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

/// Values over their spread about their mean; `None` when they do not vary.
fn standardised(x: &[f64]) -> Option<Vec<f64>> {
    let mean = x.iter().sum::<f64>() / x.len().max(1) as f64;
    let spread = (x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / x.len().max(1) as f64).sqrt();
    let varies = spread > 1e-9 * x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    varies.then(|| x.iter().map(|v| (v - mean) / spread).collect())
}

/// Spearman's rank correlation, ties sharing their mean rank.
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let centre = |r: &[f64]| r.iter().map(|v| v - (r.len() as f64 + 1.0) / 2.0).collect::<Vec<_>>();
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
        let mean = first as f64 + (same as f64 + 1.0) / 2.0;
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
        let (f, p) = added_columns(&y, &[ones], &[x.clone()]).unwrap();
        let (mx, my) = (4.5, y.iter().sum::<f64>() / 10.0);
        let sxy: f64 = x.iter().zip(&y).map(|(a, b)| (a - mx) * (b - my)).sum();
        let (sxx, syy): (f64, f64) =
            (x.iter().map(|a| (a - mx).powi(2)).sum(), y.iter().map(|b| (b - my).powi(2)).sum());
        let r2 = sxy * sxy / (sxx * syy);
        assert!((f / (r2 / (1.0 - r2) * 8.0) - 1.0).abs() < 1e-9);
        assert!(p < 1e-8);
    }
}
