//! Exact tests of runs before and after a change, case by case.
//!
//! If nothing changed, the runs of a case before and now are exchangeable: which of them came later says nothing. Of a case with `k` hits in
//! `R + r` runs, the `r` later ones then have a hypergeometric number of hits, and the sum over the cases follows the convolution of
//! these laws: with one run each this is the exact test of `McNemar`, with several it is exact for any scatter of any case. The same exchange of
//! continuous values gives a permutation test; exchanges are drawn until enough of them are as extreme (Besag and Clifford 1991,
//! Biometrika 78), which keeps the probability exact.

use hexbench_core::streams::{Purpose, stream};
use rand::RngExt;
use statrs::distribution::{Discrete, Hypergeometric};

/// Exchanges as extreme after which no more are drawn.
const ENOUGH: usize = 30;
/// So many of the exchanges drawn at most could be as extreme, and still be below the level.
const AS_EXTREME: f64 = 4.0;
/// Exchanges drawn at most, whatever the level.
const MOST_DRAWN: u32 = 10_000_000;

/// Hits of one case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaseHits {
    /// Before, and in how many runs.
    pub before: [u64; 2],
    /// Now, and in how many runs.
    pub now: [u64; 2],
}

/// Probabilities of so many hits or more now, and of so few or fewer, over all cases.
pub fn hits(cases: &[CaseHits]) -> [f64; 2] {
    let open = cases.iter().filter(|c| (1..c.before[1] + c.now[1]).contains(&(c.before[0] + c.now[0])));
    let mut law = vec![1.0];
    let mut observed = 0;
    for case in open {
        observed += usize::try_from(case.now[0]).unwrap_or(usize::MAX);
        law = convolved(&law, case);
    }
    let or_more: f64 = law.iter().skip(observed).sum();
    let or_fewer: f64 = law.iter().take(observed.saturating_add(1)).sum();
    [or_more.min(1.0), or_fewer.min(1.0)]
}

/// The law of a sum with one case more.
fn convolved(law: &[f64], case: &CaseHits) -> Vec<f64> {
    let (all, runs) = (case.before[0] + case.now[0], case.before[1] + case.now[1]);
    let Ok(own) = Hypergeometric::new(runs, all, case.now[1]) else { return law.to_vec() };
    let own: Vec<f64> = (0..=all.min(case.now[1])).map(|hits| own.pmf(hits)).collect();
    let mut sum = vec![0.0; law.len() + own.len() - 1];
    for (k, a) in law.iter().enumerate() {
        own.iter().enumerate().for_each(|(j, b)| sum[k + j] += a * b);
    }
    sum
}

/// Probabilities that exchanged runs give so large a sum over the cases now or a larger one, and so small a one or a smaller; each
/// case has the same number of runs `before` and `now`. Below `level` the first is resolved as far as a comparison with it needs.
pub fn sizes(before: &[Vec<f64>], now: &[Vec<f64>], level: f64) -> [f64; 2] {
    let later = now.first().map_or(0, Vec::len);
    let mut pooled: Vec<Vec<f64>> =
        now.iter().zip(before).map(|(n, b)| n.iter().chain(b).copied().collect()).collect();
    pooled.retain(|case| case.iter().any(|value| value.to_bits() != case[0].to_bits()));
    if pooled.is_empty() {
        return [1.0, 1.0];
    }
    let sum = |pooled: &[Vec<f64>]| pooled.iter().map(|case| case[..later].iter().sum::<f64>()).sum::<f64>();
    let observed = sum(&pooled);
    let rounding = 1e-12 * (1.0 + pooled.iter().flatten().map(|v| v.abs()).sum::<f64>());
    let most = (1..MOST_DRAWN).find(|drawn| f64::from(*drawn) * level >= AS_EXTREME).unwrap_or(MOST_DRAWN);
    let mut rng = stream(0, Purpose::GateExchange, [pooled.len() as u64]);
    let (mut extreme, mut settled) = ([0usize; 2], [None; 2]);
    for drawn in 1..=most {
        for case in &mut pooled {
            // Every choice of the later runs is as probable: a partial shuffle of Fisher and Yates.
            let runs = case.len();
            (0..later).for_each(|k| case.swap(k, rng.random_range(k..runs)));
        }
        let found = sum(&pooled);
        extreme[0] += usize::from(found >= observed - rounding);
        extreme[1] += usize::from(found <= observed + rounding);
        for (count, chance) in extreme.iter().zip(&mut settled) {
            if *count == ENOUGH && chance.is_none() {
                *chance = Some(ENOUGH as f64 / f64::from(drawn));
            }
        }
        if settled.iter().all(Option::is_some) {
            break;
        }
    }
    let unsettled = extreme.map(|count| (count + 1) as f64 / f64::from(most + 1));
    [settled[0].unwrap_or(unsettled[0]), settled[1].unwrap_or(unsettled[1])]
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{Binomial, DiscreteCDF};

    use super::*;

    fn case(before: u64, of: u64, now: u64, of_now: u64) -> CaseHits {
        CaseHits { before: [before, of], now: [now, of_now] }
    }

    #[test]
    fn with_one_run_each_it_is_the_exact_test_of_mcnemar() {
        let [gained, lost, same] = [(0, 1), (1, 0), (1, 1)].map(|(b, n)| case(b, 1, n, 1));
        let cases: Vec<_> = [vec![gained; 9], vec![lost; 2], vec![same; 30]].concat();
        let expected = Binomial::new(0.5, 11).unwrap().sf(8);
        assert!((hits(&cases)[0] / expected - 1.0).abs() < 1e-12, "{:?} {expected}", hits(&cases));
    }

    #[test]
    fn hits_in_every_later_run_of_cases_that_had_none_multiply() {
        // One of C(10, 5) = 252 choices of five runs, for each of two cases.
        let found = hits(&[case(0, 5, 5, 5), case(0, 5, 5, 5), case(0, 5, 0, 5)])[0];
        assert!((found * 252.0 * 252.0 - 1.0).abs() < 1e-9, "{found}");
        assert!(hits(&[case(0, 5, 0, 5)]).iter().all(|p| *p >= 1.0));
    }

    #[test]
    fn drawn_exchanges_agree_with_all_of_them() {
        // Three cases of one run before and two now: 27 exchanges, written out.
        let values = [[0.1, 0.9, 2.0], [1.0, 1.5, 1.2], [0.0, 0.3, 0.1]];
        let before: Vec<Vec<f64>> = values.iter().map(|v| vec![v[0]]).collect();
        let now: Vec<Vec<f64>> = values.iter().map(|v| v[1..].to_vec()).collect();
        let observed: f64 = now.iter().flatten().sum();
        let all: Vec<f64> = (0..27)
            .map(|n| {
                let left_out = [n % 3, n / 3 % 3, n / 9];
                values.iter().zip(left_out).map(|(v, k)| v.iter().sum::<f64>() - v[k]).sum()
            })
            .collect();
        let exact = all.iter().filter(|s| **s >= observed - 1e-12).count() as f64 / 27.0;
        let found = sizes(&before, &now, 1e-3)[0];
        assert!((found - exact).abs() < 4.0 * (exact / ENOUGH as f64).sqrt(), "{found}, of all {exact}");
    }
}
