//! When is a change more than chance?
//!
//! Both the run and the baseline are samples: with `n1` values now and `n0` before, each limit asks how probable so large a
//! difference would be if nothing had changed.
//!
//! - Shares: Fisher's exact test (1935), one-sided. Given all hits of both samples together, their number in the new one is
//!   hypergeometric; no approximation. One campaign counts once, so that the trials are independent.
//! - Errors and counts: `t = (m1 - m0) / (s sqrt(1/n1 + 1/n0))` of logarithms clipped to a range, Student with `n0 - 1` degrees of
//!   freedom; `s` is that of the baseline. Errors are heavy-tailed, their logarithms are not.
//! - Pulls: the ratio of two mean squares follows the F law. One campaign gives one value, the mean square of its numbers in their
//!   covariance; since these are neither normal nor of equal count, the degrees of freedom are those that give the variance `v`
//!   seen in the baseline, `2 n m^2 / v` (Satterthwaite 1946), with two standard errors of `v` on top: a baseline whose pulls
//!   happen to scatter little would otherwise raise false alarms. A variance that moved away from 1 either way is a change for the
//!   worse.
//! - No values at all: some limits look at campaigns that chance chooses (those well visible). Of the `n0` values of `R` runs and
//!   those of this one, each is as probably in any run, so that this one has none with probability `(R / (R + 1))^n0` at most.
//! - Without noise: no chance. The same machines are fitted in every run, and what is left is the linearization of the model on
//!   them: [`RATIO`]. Where it is rounding, its derived bound must hold.
//!
//! - On the same campaigns (the seed of the baseline): the rule of the gate for a program without scatter
//!   ([`crate::alarm::same_cases`]), whatever chance would allow among other campaigns. One bad answer more is a change for the worse,
//!   and so is a mean over many of them that grew by more than its tolerance; an unchanged program gives the same values.
//!
//! A run with `L` limits in which chance takes part fails wrongly with a probability of at most [`crate::alarm::FALSE_ALARM`], of which each
//! limit has the share `1 / L` (Bonferroni).

use statrs::distribution::{ContinuousCDF, DiscreteCDF, FisherSnedecor, Hypergeometric, StudentsT};

use super::baseline::FirstRun;
use super::limit::LimitTest;
use super::sample::CondensedValues;
use crate::alarm::LimitVerdict;
use crate::alarm::same_cases::FigureKind;

/// Errors without noise may grow by this factor: solvers stop within a hundredth of a percent of the same point, so that half as
/// much again is no rounding.
pub const RATIO: f64 = 1.5;

/// By how much a limit grew over the same campaigns, as the rule for the same cases weighs it; a variance is the worse the farther it
/// is from one.
pub(super) fn growth(test: LimitTest, now: &CondensedValues, first: &FirstRun) -> (FigureKind, f64) {
    let mean = now.moments().0;
    if let (LimitTest::Share, &CondensedValues::Share { hits, .. }) = (test, now) {
        return (FigureKind::Hit, hits as f64 - first.mean * first.n as f64);
    }
    let grown = match test {
        _ if now.count() == 0 || !mean.is_finite() => f64::INFINITY,
        LimitTest::Spread => mean.ln().abs() - first.mean.ln().abs(),
        _ => mean - first.mean,
    };
    (FigureKind::Size { range: [0.0, f64::INFINITY] }, grown)
}

/// How a limit compares, and how probable that is by chance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitJudgement {
    /// The verdict.
    pub verdict: LimitVerdict,
    /// Probability of a change for the worse this large by chance; `None` where chance takes no part.
    pub chance: Option<f64>,
}

/// Compares a sample with the baseline's of the same kind, gathered in so many runs; `level` is the limit's share of
/// [`crate::alarm::FALSE_ALARM`].
pub fn judge(
    test: LimitTest,
    now: &CondensedValues,
    before: &CondensedValues,
    runs: usize,
    level: f64,
) -> LimitJudgement {
    if let (CondensedValues::Exact { values: now }, CondensedValues::Exact { values: before }) = (now, before)
    {
        return exact(test, now, before);
    }
    if before.count() < 2 {
        return LimitJudgement { verdict: LimitVerdict::Same, chance: Some(1.0) };
    }
    let [worse, better] = match test {
        _ if now.count() == 0 => [none(before, runs), 1.0],
        LimitTest::Share => shares(now, before),
        LimitTest::Spread => spreads(now, before),
        _ => sizes(test, now, before),
    };
    LimitJudgement { verdict: LimitVerdict::of(worse <= level, better <= level), chance: Some(worse) }
}

/// Probability that a run has no values when so many runs have those of the baseline.
fn none(before: &CondensedValues, runs: usize) -> f64 {
    (runs as f64 / (runs + 1) as f64).powf(before.count() as f64)
}

/// Probabilities of so many hits or more, and of so few or fewer.
fn shares(now: &CondensedValues, before: &CondensedValues) -> [f64; 2] {
    let (&CondensedValues::Share { hits, of }, &CondensedValues::Share { hits: hits_before, of: of_before }) =
        (now, before)
    else {
        return [1.0, 1.0];
    };
    let Ok(law) = Hypergeometric::new(of + of_before, hits + hits_before, of) else { return [1.0, 1.0] };
    let or_more = if hits == 0 { 1.0 } else { law.sf(hits - 1) };
    [or_more, law.cdf(hits)]
}

fn sizes(test: LimitTest, now: &CondensedValues, before: &CondensedValues) -> [f64; 2] {
    let (n1, n0) = (now.count() as f64, before.count() as f64);
    let t = (now.moments().0 - before.moments().0) / (deviation(test, before) * (1.0 / n1 + 1.0 / n0).sqrt());
    let law = StudentsT::new(0.0, 1.0, n0 - 1.0);
    law.map_or([1.0, 1.0], |law| [law.sf(t), law.cdf(t)])
}

/// Standard deviation of logarithms.
pub(super) fn deviation(test: LimitTest, before: &CondensedValues) -> f64 {
    let least = if let LimitTest::Size { least, .. } = test { least } else { 0.0 };
    before.moments().1.sqrt().max(least)
}

/// Both ways: what moved away from 1 is worse, what came closer is better.
fn spreads(now: &CondensedValues, before: &CondensedValues) -> [f64; 2] {
    let (m1, m0) = (now.moments().0, before.moments().0);
    let [nu1, nu0] = degrees(now.count(), before);
    let Ok(law) = FisherSnedecor::new(nu1, nu0) else { return [1.0, 1.0] };
    let ratio = m1 / m0;
    let chance = (2.0 * law.sf(ratio).min(law.cdf(ratio))).min(1.0);
    let farther = m1.ln().abs() > m0.ln().abs();
    if farther { [chance, 1.0] } else { [1.0, chance] }
}

/// Degrees of freedom of so many values now, and of the baseline.
pub(super) fn degrees(now: u64, before: &CondensedValues) -> [f64; 2] {
    let (mean, variance) = before.moments();
    // The variance of chi-square pulls of some six numbers has a relative standard error of 2 / sqrt(n).
    let caution = 1.0 + 4.0 / (before.count() as f64).sqrt();
    let each = 2.0 * mean * mean / (caution * variance).max(f64::MIN_POSITIVE);
    [now, before.count()].map(|n| (each * n as f64).clamp(1.0, 1e6))
}

fn exact(test: LimitTest, now: &[Option<f64>], before: &[Option<f64>]) -> LimitJudgement {
    let worse = match test {
        LimitTest::Bound => now.iter().any(|v| v.is_none_or(|v| v > 1.0)),
        _ => now.len() < before.len() || pairs(now, before).any(|(a, b)| a > RATIO * b),
    };
    let better =
        test == LimitTest::Exact && !now.is_empty() && pairs(now, before).all(|(a, b)| RATIO * a < b);
    LimitJudgement { verdict: LimitVerdict::of(worse, better), chance: None }
}

/// A value that was not found is beyond every other.
fn pairs(now: &[Option<f64>], before: &[Option<f64>]) -> impl Iterator<Item = (f64, f64)> {
    let found = |v: &Option<f64>| v.unwrap_or(f64::INFINITY);
    now.iter().zip(before).map(move |(a, b)| (found(a), found(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEVEL: f64 = 1e-5;
    const RUNS: usize = 8;
    const DIGITS: f64 = 1e-6;

    fn share(hits: u64, of: u64) -> CondensedValues {
        CondensedValues::Share { hits, of }
    }

    #[test]
    fn shares_agree_with_hypergeometric_sums_of_exact_integers() {
        // sum(comb(29, k) * comb(871, 100 - k) for k in range(9, 30)) / comb(900, 100) in Python 3, and of 40 hits from 20 on.
        for (hits, before, expected) in [(9, 20, 2.707_570_301_076_7e-3), (20, 20, 2.943_457_873_222_414e-10)]
        {
            let found = judge(LimitTest::Share, &share(hits, 100), &share(before, 800), RUNS, LEVEL);
            let chance = found.chance.unwrap();
            assert!((chance / expected - 1.0).abs() < DIGITS, "{chance} instead of {expected}");
            assert_eq!(found.verdict == LimitVerdict::Worse, expected < LEVEL);
        }
    }

    #[test]
    fn twice_the_errors_of_many_campaigns_are_worse_and_half_of_them_better() {
        let test = LimitTest::Size {
            range: [1e-9, 10.0],
            least: 0.1,
            unit: crate::regress::limit::LimitUnit::Percent,
        };
        let sample = |factor: f64, n: usize| {
            let values: Vec<f64> = (0..n).map(|k| factor * ((k % 7) as f64 - 3.0).exp()).collect();
            CondensedValues::of(test, &values)
        };
        let verdict =
            |factor: f64| judge(test, &sample(factor, 700), &sample(0.1, 5600), RUNS, LEVEL).verdict;
        assert_eq!(
            [0.05, 0.1, 0.2].map(verdict),
            [LimitVerdict::Better, LimitVerdict::Same, LimitVerdict::Worse]
        );
    }

    #[test]
    fn a_variance_that_leaves_one_either_way_is_worse_and_one_that_comes_back_is_better() {
        let sample = |m: f64, n: u64| CondensedValues::Spread {
            n,
            sum: m * n as f64,
            squares: 1.33 * m * m * n as f64,
        };
        let verdict = |m1: f64, m0: f64| {
            judge(LimitTest::Spread, &sample(m1, 300), &sample(m0, 2400), RUNS, LEVEL).verdict
        };
        assert_eq!(verdict(1.5, 1.0), LimitVerdict::Worse);
        assert_eq!(verdict(0.6, 1.0), LimitVerdict::Worse);
        assert_eq!(verdict(1.05, 1.0), LimitVerdict::Same);
        assert_eq!(verdict(1.0, 1.5), LimitVerdict::Better);
    }

    #[test]
    fn errors_without_noise_may_not_grow_by_half_nor_vanish_from_sight() {
        let sample = |values: &[Option<f64>]| CondensedValues::Exact { values: values.to_vec() };
        let before = sample(&[Some(1e-4), Some(2e-4)]);
        let verdict =
            |now: &[Option<f64>]| judge(LimitTest::Exact, &sample(now), &before, RUNS, LEVEL).verdict;
        assert_eq!(verdict(&[Some(1.4e-4), Some(2e-4)]), LimitVerdict::Same);
        assert_eq!(verdict(&[Some(1.6e-4), Some(2e-4)]), LimitVerdict::Worse);
        assert_eq!(verdict(&[Some(1e-4), None]), LimitVerdict::Worse);
        assert_eq!(verdict(&[Some(1e-4)]), LimitVerdict::Worse);
        assert_eq!(verdict(&[Some(1e-5), Some(1e-5)]), LimitVerdict::Better);
        let bound =
            |v: f64| judge(LimitTest::Bound, &sample(&[Some(v)]), &sample(&[Some(0.1)]), RUNS, LEVEL).verdict;
        assert_eq!([0.9, 1.1].map(bound), [LimitVerdict::Same, LimitVerdict::Worse]);
    }

    #[test]
    fn no_values_where_the_baseline_has_many_are_worse() {
        assert_eq!(
            judge(LimitTest::Share, &share(0, 0), &share(2, 800), RUNS, LEVEL).verdict,
            LimitVerdict::Worse
        );
        assert_eq!(
            judge(LimitTest::Share, &share(0, 0), &share(0, 0), RUNS, LEVEL).verdict,
            LimitVerdict::Same
        );
    }

    #[test]
    fn no_values_where_the_baseline_has_few_may_be_chance() {
        // Four values in three runs: one more run has none of them with probability (3/4)^4.
        let found = judge(LimitTest::Share, &share(0, 0), &share(1, 4), 3, LEVEL);
        assert_eq!((found.verdict, found.chance), (LimitVerdict::Same, Some(81.0 / 256.0)));
    }
}
