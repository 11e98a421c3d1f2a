//! Rank correlation (Spearman, 1904), and its bounds by resampling the pairs.

use hexbench_core::statistics::quantile;
use hexbench_core::streams::{Purpose, stream};
use rand::RngExt;

/// Samples drawn from the pairs.
const RESAMPLES: u64 = 400;

/// Rank correlation of pairs, and bounds that miss the true one with this chance; the same pairs give the same bounds.
pub fn rank_correlation(pairs: &[[f64; 2]], error: f64) -> [f64; 3] {
    bounded(pairs.len(), error, |chosen| of_chosen(pairs, chosen))
}

/// By how much the first of two numbers goes better with a third than the second does, as a difference of rank correlations, with
/// bounds as [`rank_correlation`].
pub(in crate::sweep::page) fn rank_advantage(
    first: &[[f64; 2]],
    second: &[[f64; 2]],
    error: f64,
) -> [f64; 3] {
    bounded(first.len(), error, |chosen| of_chosen(first, chosen) - of_chosen(second, chosen))
}

/// A statistic of all pairs, and quantiles of that of resampled ones.
fn bounded(count: usize, error: f64, of: impl Fn(&[usize]) -> f64) -> [f64; 3] {
    let resample = |number: u64| {
        let mut rng = stream(0, Purpose::Study, [number, count as u64]);
        of(&(0..count).map(|_| rng.random_range(0..count)).collect::<Vec<_>>())
    };
    let resampled: Vec<f64> = (0..RESAMPLES).map(resample).filter(|x| x.is_finite()).collect();
    let at = |share: f64| quantile(resampled.iter().copied(), share).unwrap_or(f64::NAN);
    [of(&(0..count).collect::<Vec<_>>()), at(0.5 * error), at(1.0 - 0.5 * error)]
}

fn of_chosen(pairs: &[[f64; 2]], chosen: &[usize]) -> f64 {
    spearman(&chosen.iter().map(|&k| pairs[k]).collect::<Vec<_>>())
}

fn spearman(pairs: &[[f64; 2]]) -> f64 {
    let [x, y] = [0, 1].map(|k| ranks(&pairs.iter().map(|pair| pair[k]).collect::<Vec<_>>()));
    let middle = 0.5 * (pairs.len() as f64 - 1.0);
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>();
    sum(&x, &y) / (sum(&x, &x) * sum(&y, &y)).sqrt()
}

/// Places in ascending order; equal values share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    for same in order.chunk_by(|&a, &b| values[a].total_cmp(&values[b]).is_eq()) {
        let mean = first as f64 + 0.5 * (same.len() as f64 - 1.0);
        for &k in same {
            ranks[k] = mean;
        }
        first += same.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn ranks_of_known_pairs() {
        // scipy.stats.spearmanr([1, 2, 3, 4, 5], [5, 6, 7, 8, 7]): 0.8208.
        let pairs = [[1.0, 5.0], [2.0, 6.0], [3.0, 7.0], [4.0, 8.0], [5.0, 7.0]];
        assert!((spearman(&pairs) - 0.820_782_681_668_123_3).abs() < 1e-12, "{}", spearman(&pairs));
    }

    #[test]
    fn bounds_hold_the_true_rank_correlation_as_often_as_they_say() {
        const RUNS: u64 = 300;
        const PAIRS: usize = 100;
        const RHO: f64 = 0.8;
        // Of a normal pair: 6 / pi asin(rho / 2) (Pearson, 1907).
        let truth = 6.0 / std::f64::consts::PI * (0.5 * RHO).asin();
        let held = (0..RUNS).filter(|&run| {
            let mut rng = stream(5, Purpose::Example, [run]);
            let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
            let pair = |_| {
                let (x, z) = (normal(), normal());
                [x, RHO * x + (1.0 - RHO * RHO).sqrt() * z]
            };
            let pairs: Vec<[f64; 2]> = (0..PAIRS).map(pair).collect();
            let [_, low, high] = rank_correlation(&pairs, 0.05);
            (low..=high).contains(&truth)
        });
        let held = held.count() as f64 / RUNS as f64;
        // Three standard deviations of 300 runs, and a percent that percentiles of resamples are short of.
        assert!(held > 0.95 - 0.038 - 0.01, "{held}");
    }
}
