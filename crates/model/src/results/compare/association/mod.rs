//! What the residual elongations of the legs follow.
//!
//! For every leg, and all legs together, and every variable `x`, the elongation is regressed on `s x` and `s x^2` beside
//! `s`, where the carrier `s` is 1 (the length changes) or the change of leg force (the compliance changes). The F test
//! of the two added columns gives a chance, multiplied by the number of questions asked (Bonferroni). Spearman's rank
//! correlation of elongation over carrier with the variable tells the direction.
//!
//! The regression is made on the whitened readings, where noise is independent, beside everything the fit has absorbed, so
//! F is exact for Gaussian noise. The questions overlap; the diagnosis weighs effects against each other.

mod columns;
mod questions;
mod sums;

use serde::Serialize;

use super::JudgedModel;
use super::follows::Follows;
use crate::estimation::campaign::Condition;
use questions::{Question, Values, questions, values};

pub(crate) use columns::{Look, added_columns};
use columns::{dot, square};

/// Associations kept.
const KEPT: usize = 12;
/// Chance after correction below which an association is reported.
const REPORTED: f64 = 0.01;
/// Word for the carrier that is the change of leg force.
pub(crate) const COMPLIANCE: &str = "compliance";

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
    let values = values(judged);
    let questions = questions(judged, &values);
    let tests = sums::tests(judged, &values, &questions)
        .unwrap_or_else(|| questions.iter().map(|q| column_by_column(judged, q)).collect());
    let asked = tests.iter().flatten().count() as f64;
    let corrected = |(q, test): (_, Option<(f64, f64)>)| test.map(|(f, p)| (q, f, (p * asked).min(1.0)));
    let mut all: Vec<(&Question, f64, f64)> =
        questions.iter().zip(tests).filter_map(corrected).filter(|(_, _, p)| *p < REPORTED).collect();
    all.sort_by(|a, b| a.2.total_cmp(&b.2).then(b.1.total_cmp(&a.1)));
    all.truncate(KEPT);
    all.into_iter().map(|(q, f, p)| Association::of(judged, &values, q, f, p)).collect()
}

/// F and chance of a question, by its own columns.
fn column_by_column(judged: &JudgedModel<'_>, question: &Question) -> Option<(f64, f64)> {
    let look = Look { judged, leg: question.leg, compliance: question.compliance };
    let x = |c: &Condition, l: usize| question.scaled(&Follows::values(c))[l];
    let mut added = vec![look.column(x)];
    if question.powers() > 1 {
        added.push(look.column(|c, l| x(c, l).powi(2)));
    }
    added_columns(judged.white.as_slice(), &[look.column(|_, _| 1.0)], &added, judged.rank)
}

impl Association {
    fn of(judged: &JudgedModel<'_>, values: &[Values], question: &Question, f: f64, p: f64) -> Self {
        let (mut y, mut x) = (Vec::new(), Vec::new());
        for i in judged.space.determined() {
            let (change, scaled) = (judged.lin.conditions[i].force_change(), question.scaled(&values[i]));
            for l in (0..6).filter(|l| question.leg.is_none_or(|only| only == *l)) {
                let sign = if question.compliance { change[l].signum() } else { 1.0 };
                y.push(sign * judged.space.elongation[i][l] / judged.space.sigma[i][l]);
                x.push(scaled[l]);
            }
        }
        Self {
            leg: question.leg.map(|l| l + 1),
            variable: question.variable().name(),
            of: if question.compliance { COMPLIANCE } else { "length" },
            rank_correlation: spearman(&y, &x),
            f,
            p,
        }
    }
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
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;
    use crate::estimation::fit::fit_baseline;
    use crate::results::diagnose::prepare;
    use hexbench_core::files::{read_hexapod, read_measurements};

    #[test]
    fn tests_from_sums_are_those_of_columns() {
        let read = |name: &str| {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/cases/not-in-catalogue");
            std::path::Path::new(folder).join(name)
        };
        let hexapod = read_hexapod(&read("hexapod.toml")).unwrap();
        let data = read_measurements(&read("measurements.csv")).unwrap().dataset;
        let campaign = prepare(&hexapod, &data).unwrap();
        let fit = fit_baseline(&campaign).unwrap();
        let judged = JudgedModel::of(&campaign, &data, &fit.point, true).unwrap();
        assert!(judged.lin.whitened_out().unwrap().ncols() > 0);
        let values = values(&judged);
        let questions = questions(&judged, &values);
        let fast = sums::tests(&judged, &values, &questions).unwrap();
        assert!(fast.iter().flatten().count() > 100);
        for (question, fast) in questions.iter().zip(fast) {
            let plain = column_by_column(&judged, question);
            let name = (question.leg, question.variable(), question.compliance);
            assert_eq!(fast.is_some(), plain.is_some(), "{name:?}");
            let (Some(fast), Some(plain)) = (fast, plain) else { continue };
            let same = (fast.0 / plain.0 - 1.0).abs() < 1e-7 && (fast.1 / plain.1 - 1.0).abs() < 1e-6;
            assert!(same, "{name:?}: {fast:?} {plain:?}");
        }
    }

    #[test]
    fn ranks_correlate_whatever_the_scale() {
        let x: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert!((spearman(&x, &x.map(f64::exp)) - 1.0).abs() < 1e-15);
        assert!((spearman(&x, &x.map(|v| -v)) + 1.0).abs() < 1e-15);
        // By hand: ranks [1, 2.5, 2.5, 4] against [1, 2, 3, 4].
        assert!((spearman(&[1.0, 2.0, 2.0, 3.0], &x[..4]) - 4.5 / 22.5_f64.sqrt()).abs() < 1e-12);
    }
}
