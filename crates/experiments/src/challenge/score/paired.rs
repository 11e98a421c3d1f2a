//! Programs against the best of them, case by case: what all cases have in common falls out.

use hexbench_core::statistics::Proportion;
use statrs::distribution::{Binomial, DiscreteCDF};

use super::EntrantScore;
use super::case::CaseScore;
use super::figures::{Mean, mean};

/// Errors below count as this: a ratio needs numbers above zero.
const LEAST: f64 = 1e-9;

/// A ratio of geometric means and its 95 % interval; no interval for a single case or the same numbers.
pub type Ratio = (f64, Option<[f64; 2]>);

/// Geometric mean of an error of one program over that of another, on the cases for which both state it; and the count of cases.
pub(super) fn ratio_of(pairs: impl Iterator<Item = (Option<f64>, Option<f64>)>) -> Option<(Ratio, usize)> {
    let differences: Vec<f64> = pairs.filter_map(|(a, b)| Some(logarithm(a?) - logarithm(b?))).collect();
    mean(&differences).map(|m| (ratio(m), m.of))
}

fn logarithm(error: f64) -> f64 {
    error.max(LEAST).ln()
}

fn ratio(m: Mean) -> Ratio {
    let interval = m.interval().filter(|_| m.standard_error.is_some_and(|se| se > 0.0));
    (m.mean.exp(), interval.map(|bounds| bounds.map(f64::exp)))
}

/// Geometric mean of errors against the best, on the cases for which all that state anything do.
#[derive(Debug, Clone, PartialEq)]
pub struct Ratios {
    /// Cases compared.
    pub cases: usize,
    /// One for each program: ratio and its 95 % interval (Student's t of the logarithms); the best has 1 without interval.
    pub of: Vec<Option<Ratio>>,
}

/// Differences of mean scores against the best, on the cases for which all that state anything do.
#[derive(Debug, Clone, PartialEq)]
pub struct Differences {
    /// Cases compared.
    pub cases: usize,
    /// One for each program: mean difference with its standard error; the best has 0.
    pub of: Vec<Option<Mean>>,
}

impl Ratios {
    /// Compares an error of every case.
    pub fn of(entrants: &[EntrantScore], error: impl Fn(&CaseScore) -> Option<f64>) -> Self {
        let compared = Differences::of(entrants, |c| error(c).map(logarithm));
        Self { cases: compared.cases, of: compared.of.into_iter().map(|d| d.map(ratio)).collect() }
    }
}

impl Differences {
    /// Compares a score of every case.
    pub fn of(entrants: &[EntrantScore], score: impl Fn(&CaseScore) -> Option<f64>) -> Self {
        let all: Vec<Vec<Option<f64>>> =
            entrants.iter().map(|e| e.cases.iter().map(&score).collect()).collect();
        let stating: Vec<&Vec<Option<f64>>> = all.iter().filter(|s| s.iter().any(Option::is_some)).collect();
        let length = all.first().map_or(0, Vec::len);
        let common: Vec<usize> = (0..length)
            .filter(|&k| !stating.is_empty() && stating.iter().all(|scores| scores[k].is_some()))
            .collect();
        let on_common =
            |scores: &Vec<Option<f64>>| common.iter().filter_map(|&k| scores[k]).collect::<Vec<f64>>();
        let mean_of = |scores: &Vec<f64>| scores.iter().sum::<f64>();
        let columns: Vec<Vec<f64>> = all.iter().map(on_common).collect();
        let full = columns.iter().filter(|c| !c.is_empty() && c.len() == common.len());
        let best = full.min_by(|a, b| mean_of(a).total_cmp(&mean_of(b))).cloned().unwrap_or_default();
        let against = |column: &Vec<f64>| {
            let differences: Vec<f64> = column.iter().zip(&best).map(|(x, b)| x - b).collect();
            mean(&differences).filter(|_| column.len() == best.len())
        };
        Self { cases: common.len(), of: columns.iter().map(against).collect() }
    }
}

/// Cases in which one program has something that another lacks, and the other way round, on the cases that both answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exchanges {
    /// Cases that both answer.
    pub cases: usize,
    /// Cases in which only the program has it.
    pub gained: usize,
    /// Cases in which only the other has it.
    pub lost: usize,
}

impl Exchanges {
    /// Counts them; `None` of a case: not answered.
    pub fn count(pairs: impl Iterator<Item = (Option<bool>, Option<bool>)>) -> Self {
        let mut found = Self { cases: 0, gained: 0, lost: 0 };
        for (own, others) in pairs.filter_map(|(own, others)| Some((own?, others?))) {
            found.cases += 1;
            found.gained += usize::from(own && !others);
            found.lost += usize::from(others && !own);
        }
        found
    }

    /// Probability of so uneven an exchange when both are as good: exact test of `McNemar` (1947), two-sided.
    pub fn chance(&self) -> f64 {
        let all = (self.gained + self.lost) as u64;
        let fewer = self.gained.min(self.lost) as u64;
        Binomial::new(0.5, all).map_or(1.0, |law| (2.0 * law.cdf(fewer)).min(1.0))
    }

    /// Difference of both shares with its 95 % interval, from the exact interval of the share of the exchanges that are gains.
    pub fn difference(&self) -> Option<(f64, [f64; 2])> {
        let exchanged = self.gained + self.lost;
        if self.cases == 0 {
            return None;
        }
        let scale = exchanged as f64 / self.cases as f64;
        let gains = Proportion { hits: self.gained, of: exchanged };
        let bounds =
            if exchanged == 0 { [0.0; 2] } else { gains.interval().map(|p| scale * (2.0 * p - 1.0)) };
        Some(((self.gained as f64 - self.lost as f64) / self.cases as f64, bounds))
    }
}
