//! Shares of trials that come in clusters: those of a cluster share a machine, a plan, an effect, and tend to end alike.
//!
//! Exact binomial bounds of an effective number of trials (Korn and Graubard, Survey Methodology 24, 1998):
//!
//! ```text
//! n* = p (1 - p) / var(p) * (t(n - 1) / t(d - 1))^2,  n* <= n     d clusters, var(p) from the scatter of their hits
//! ```
//!
//! Where a few clusters are of another kind than the rest, bounds of 20 clusters hold the truth in 91 % instead of 95 %; clusters of
//! one trial have exact bounds. Where nothing or everything is a hit, clusters show no scatter, and each counts once.

use statrs::distribution::{Beta, ContinuousCDF, StudentsT};

/// Hits among trials in clusters.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClusteredShare {
    clusters: u64,
    hits: u64,
    of: u64,
    /// Sums over clusters of hits^2, hits * trials, trials^2.
    squares: [f64; 3],
}

impl ClusteredShare {
    /// Adds a cluster; one without trials tells nothing.
    pub fn add(&mut self, hits: u64, of: u64) {
        let [h, n] = [hits as f64, of as f64];
        self.clusters += u64::from(of > 0);
        self.hits += hits;
        self.of += of;
        self.squares.iter_mut().zip([h * h, h * n, n * n]).for_each(|(sum, x)| *sum += x);
    }

    /// Clusters of both.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.clusters += other.clusters;
        self.hits += other.hits;
        self.of += other.of;
        self.squares.iter_mut().zip(other.squares).for_each(|(sum, x)| *sum += x);
        self
    }

    /// How often it happened.
    pub fn hits(&self) -> u64 {
        self.hits
    }

    /// How often it could have.
    pub fn of(&self) -> u64 {
        self.of
    }

    /// The share; NaN of nothing.
    pub fn rate(&self) -> f64 {
        self.hits as f64 / self.of as f64
    }

    /// Two-sided bounds that miss the true share with at most this chance; NaN of nothing.
    pub fn interval(&self, error: f64) -> [f64; 2] {
        if self.of == 0 {
            return [f64::NAN; 2];
        }
        let n = self.effective(error);
        let [hits, misses] = [n * self.rate(), n * (1.0 - self.rate())];
        let quantile = |a: f64, b: f64, at: f64| Beta::new(a, b).ok().map(|law| law.inverse_cdf(at));
        [
            quantile(hits, misses + 1.0, 0.5 * error).unwrap_or(0.0),
            quantile(hits + 1.0, misses, 1.0 - 0.5 * error).unwrap_or(1.0),
        ]
    }

    /// Independent trials that tell as much.
    fn effective(&self, error: f64) -> f64 {
        let [n, d] = [self.of as f64, self.clusters as f64];
        if self.clusters == self.of {
            return n;
        }
        if self.clusters < 2 || self.hits == 0 || self.hits == self.of {
            return d;
        }
        let p = self.rate();
        let [hh, hn, nn] = self.squares;
        let variance = d / (d - 1.0) * (hh - 2.0 * p * hn + p * p * nn).max(0.0) / (n * n);
        let t = |freedom: f64| {
            StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |t| t.inverse_cdf(1.0 - 0.5 * error))
        };
        let alike = p * (1.0 - p) / variance * (t(n - 1.0) / t(d - 1.0)).powi(2);
        // Rounding may leave a scatter of zero.
        if alike.is_finite() { alike.clamp(1.0, n) } else { n }
    }
}

#[cfg(test)]
mod tests {
    use rand::RngExt;

    use super::ClusteredShare;
    use crate::statistics::Proportion;
    use crate::streams::{Purpose, stream};

    #[test]
    fn clusters_of_one_trial_have_exact_binomial_bounds() {
        let mut share = ClusteredShare::default();
        (0..100).for_each(|k| share.add(u64::from(k < 5), 1));
        let exact = Proportion { hits: 5, of: 100 }.interval();
        for (found, wanted) in share.interval(0.05).iter().zip(exact) {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
    }

    #[test]
    fn nothing_and_one_cluster_tell_little() {
        assert!(ClusteredShare::default().interval(0.05)[0].is_nan());
        let mut one = ClusteredShare::default();
        one.add(20, 20);
        let [low, high] = one.interval(0.05);
        assert!(low < 0.05 && high >= 1.0, "{low} {high}");
    }

    /// Share of simulated intervals that hold the truth; a share of the clusters, the third number, has the first, others the second.
    fn coverage([usual, other, weight]: [f64; 3], clusters: usize, trials: u64, error: f64) -> f64 {
        const RUNS: usize = 2000;
        let mut rng = stream(11, Purpose::Example, [clusters as u64, trials]);
        let truth = weight * usual + (1.0 - weight) * other;
        let mut held = 0;
        for _ in 0..RUNS {
            let mut share = ClusteredShare::default();
            for _ in 0..clusters {
                let p = if rng.random_bool(weight) { usual } else { other };
                let hits = (0..trials).filter(|_| rng.random_bool(p)).count();
                share.add(hits as u64, trials);
            }
            let [low, high] = share.interval(error);
            held += usize::from((low..=high).contains(&truth));
        }
        held as f64 / RUNS as f64
    }

    #[test]
    fn bounds_hold_the_truth_as_often_as_they_say_whether_clusters_differ_or_not() {
        /// Three standard deviations of 2000 runs at 95 %.
        const CHANCE: f64 = 0.015;
        for law in [[0.9, 0.9, 1.0], [0.8, 0.6, 0.5], [1.0, 0.0, 0.9], [1.0, 0.0, 0.5], [0.5, 0.5, 1.0]] {
            for (clusters, trials) in [(20, 10), (40, 5), (12, 20), (100, 4), (100, 1)] {
                let held = coverage(law, clusters, trials, 0.05);
                assert!(held > 0.95 - CHANCE, "{law:?}, {clusters} clusters of {trials}: {held}");
            }
        }
    }

    /// Few clusters may hold none of the rare kind, and then nothing tells of it.
    #[test]
    fn bounds_of_rare_other_clusters_hold_somewhat_less_often_unless_each_has_one_trial() {
        const LAW: [f64; 3] = [0.95, 0.45, 0.9];
        assert!(coverage(LAW, 20, 10, 0.05) > 0.88);
        assert!(coverage(LAW, 200, 1, 0.05) > 0.95 - 0.015);
    }
}
