//! What a change has to do to be noticed.

use serde::{Deserialize, Serialize};
use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, Normal};

use crate::alarm::exchange::{CaseHits, hits};
use crate::alarm::same_cases::{FigureKind, RunValues, SAME_CASES};
use crate::alarm::{POWER, bisected};

/// The share of the answers that the gate is asked to notice when it becomes bad.
pub const SHARE: f64 = 0.03;
/// Cases beyond which nobody makes a suite.
const MOST_CASES: u64 = 100_000;

/// What a figure would notice.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Noticed {
    /// So many cases more that are bad in every run.
    Hits {
        /// The least number of them.
        cases: u64,
        /// Cases that can become bad.
        of: u64,
        /// Share of these that is noticed with [`POWER`] when each becomes bad with this probability; none: no share is.
        share: Option<f64>,
        /// Probability that [`SHARE`] of them is noticed.
        chance: f64,
        /// Cases of a suite in which [`SHARE`] is noticed with [`POWER`].
        needed: u64,
    },
    /// A mean that grows by this factor, with [`POWER`].
    Size {
        /// The factor.
        factor: f64,
    },
    /// Nothing: no case has the figure in every run.
    Nothing,
}

/// What a figure notices with so many runs now; `level` as in the rule.
pub fn noticed(kind: FigureKind, before: &RunValues, now_runs: usize, level: Option<f64>) -> Noticed {
    let cases = before.first().map_or(0, Vec::len);
    let of = |k: usize| before.iter().map(|run| run[k].map(|v| kind.scaled(v))).collect::<Option<Vec<f64>>>();
    let stated: Vec<Vec<f64>> = (0..cases).filter_map(of).collect();
    match kind {
        _ if stated.is_empty() => Noticed::Nothing,
        FigureKind::Hit => hits_noticed(&stated, now_runs as u64, level),
        FigureKind::Size { .. } => Noticed::Size { factor: factor(&stated, now_runs, level) },
    }
}

fn hits_noticed(stated: &[Vec<f64>], now_runs: u64, level: Option<f64>) -> Noticed {
    let count = |runs: &Vec<f64>| runs.iter().filter(|v| **v > 0.5).count() as u64;
    let clear = stated.iter().filter(|runs| count(runs) == 0).count() as u64;
    let runs = stated[0].len() as u64;
    let scattered: Vec<CaseHits> = stated
        .iter()
        .map(count)
        .filter(|hits| (1..runs).contains(hits))
        .map(|hits| CaseHits { before: [hits, runs], now: [(hits * now_runs + runs / 2) / runs, now_runs] })
        .collect();
    let fresh = CaseHits { before: [0, runs], now: [now_runs, now_runs] };
    let fails = |more: u64| {
        let cases: Vec<CaseHits> = scattered.iter().copied().chain((0..more).map(|_| fresh)).collect();
        level.is_none_or(|level| hits(&cases)[0] <= level)
    };
    let least = (1..=clear.max(1)).find(|more| fails(*more)).unwrap_or(clear + 1);
    let chance = |p: f64, of: u64| if least > of { 0.0 } else { at_least(least, of, p) };
    Noticed::Hits {
        cases: least,
        of: clear,
        share: (chance(1.0, clear) >= POWER).then(|| bisected(0.0, 1.0, |p| chance(p, clear) >= POWER)),
        chance: chance(SHARE, clear),
        needed: needed(|of| chance(SHARE, of) >= POWER),
    }
}

/// Probability of so many hits or more.
fn at_least(hits: u64, of: u64, p: f64) -> f64 {
    Binomial::new(p, of).map_or(0.0, |law| law.sf(hits - 1))
}

/// The smallest number of cases for which a statement holds, which holds for all beyond.
fn needed(holds: impl Fn(u64) -> bool) -> u64 {
    let (mut low, mut high) = (0, MOST_CASES);
    while high - low > 1 {
        let middle = u64::midpoint(low, high);
        if holds(middle) { high = middle } else { low = middle }
    }
    high
}

/// From the scatter of each case about its own mean, as of a normal law.
fn factor(stated: &[Vec<f64>], now_runs: usize, level: Option<f64>) -> f64 {
    let Some(level) = level else { return SAME_CASES };
    let runs = stated[0].len() as f64;
    let mean = |values: &Vec<f64>| values.iter().sum::<f64>() / runs;
    let squares = |values: &Vec<f64>| values.iter().map(|v| (v - mean(values)).powi(2)).sum::<f64>();
    let variance: f64 = stated.iter().map(|v| squares(v) / (runs - 1.0).max(1.0)).sum();
    let error = (variance * (1.0 / runs + 1.0 / now_runs as f64)).sqrt() / stated.len() as f64;
    let quantile = |p: f64| Normal::new(0.0, 1.0).map_or(f64::NAN, |law| law.inverse_cdf(p));
    let beyond_chance = quantile(1.0 - level) * error;
    (beyond_chance.max(SAME_CASES.ln()) + quantile(POWER) * error).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_hits(noticed: Noticed) -> (u64, u64, f64, u64) {
        match noticed {
            Noticed::Hits { cases, of, chance, needed, .. } => (cases, of, chance, needed),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn without_scatter_one_case_is_noticed_and_three_percent_of_84_with_92_percent() {
        let before = vec![vec![Some(0.0); 84]];
        let (cases, of, chance, needed) = of_hits(noticed(FigureKind::Hit, &before, 1, None));
        assert_eq!((cases, of, needed), (1, 84, 76));
        assert!((chance - (1.0 - 0.97_f64.powi(84))).abs() < 1e-12, "{chance}");
    }

    #[test]
    fn with_five_runs_each_two_cases_are_noticed_and_with_one_run_many() {
        let runs = |n: usize| vec![vec![Some(0.0); 200]; n];
        let least = |n: usize| of_hits(noticed(FigureKind::Hit, &runs(n), n, Some(1e-4))).0;
        assert_eq!([least(5), least(3), least(1)], [2, 4, 14]);
    }

    #[test]
    fn cases_that_scatter_make_it_harder() {
        let mut before = vec![vec![Some(0.0); 200]; 5];
        for k in 0..20 {
            before[k % 5][k] = Some(1.0);
        }
        let least = of_hits(noticed(FigureKind::Hit, &before, 5, Some(1e-4))).0;
        assert!((3..9).contains(&least), "{least}");
        let sizes = |scatter: f64| {
            let runs: RunValues = (0..5)
                .map(|r| (0..50).map(|k| Some(1.0 + scatter * f64::from((r + k) % 5))).collect())
                .collect();
            match noticed(FigureKind::Size { range: [1e-9, 10.0] }, &runs, 5, Some(1e-4)) {
                Noticed::Size { factor } => factor,
                other => panic!("{other:?}"),
            }
        };
        assert!(sizes(0.0) < sizes(0.05) && sizes(0.05) < sizes(0.5), "{} {}", sizes(0.0), sizes(0.5));
    }
}
