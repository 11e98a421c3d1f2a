//! Counted shares with exact binomial bounds.

use statrs::distribution::{Beta, ContinuousCDF};

/// So many hits of so many.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Proportion {
    /// How often it happened.
    pub hits: usize,
    /// How often it could have.
    pub of: usize,
}

impl Proportion {
    /// Counts the items for which `test` holds.
    pub fn count<T>(items: impl IntoIterator<Item = T>, test: impl Fn(&T) -> bool) -> Self {
        items
            .into_iter()
            .fold(Self::default(), |p, x| Self { hits: p.hits + usize::from(test(&x)), of: p.of + 1 })
    }

    /// The share; NaN of nothing.
    pub fn rate(&self) -> f64 {
        self.hits as f64 / self.of as f64
    }

    /// Two-sided 95 % bounds (Clopper and Pearson, 1934): each tail at most 2.5 %.
    pub fn interval(&self) -> [f64; 2] {
        const TAIL: f64 = 0.025;
        [self.lower(TAIL), self.upper(TAIL)]
    }

    /// One-sided 95 % bound: were the true rate larger, so few hits would have a chance below 5 %.
    pub fn upper_bound(&self) -> f64 {
        const TAIL: f64 = 0.05;
        self.upper(TAIL)
    }

    /// True when so many hits are hardly chance (below 0.1 %) at this true rate.
    pub fn is_above(&self, rate: f64) -> bool {
        const HARDLY: f64 = 1e-3;
        self.lower(HARDLY) > rate
    }

    /// True when a true rate is within the two-sided exact bounds that a share leaves with this chance of error.
    pub fn is_compatible_with(&self, rate: f64, error: f64) -> bool {
        (self.lower(0.5 * error)..=self.upper(0.5 * error)).contains(&rate)
    }

    /// Quantile of Beta(hits, misses + 1).
    fn lower(&self, tail: f64) -> f64 {
        let [hits, misses] = [self.hits as f64, (self.of - self.hits) as f64];
        Beta::new(hits, misses + 1.0).map_or(0.0, |law| law.inverse_cdf(tail))
    }

    /// Quantile of Beta(hits + 1, misses).
    fn upper(&self, tail: f64) -> f64 {
        let [hits, misses] = [self.hits as f64, (self.of - self.hits) as f64];
        Beta::new(hits + 1.0, misses).map_or(1.0, |law| law.inverse_cdf(1.0 - tail))
    }
}

impl std::iter::Sum for Proportion {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::default(), |all, p| Self { hits: all.hits + p.hits, of: all.of + p.of })
    }
}

#[cfg(test)]
mod tests {
    use super::Proportion;

    /// Published to four digits.
    const DIGITS: f64 = 5e-5;

    #[test]
    fn bounds_agree_with_published_tables() {
        // scipy.stats.binomtest(5, 100).proportion_ci(method="exact"), SciPy 1.16.
        let [low, high] = Proportion { hits: 5, of: 100 }.interval();
        assert!((low - 0.016_43).abs() < DIGITS && (high - 0.112_83).abs() < DIGITS, "{low} {high}");
    }

    #[test]
    fn no_hit_leaves_the_rule_of_three() {
        let bound = Proportion { hits: 0, of: 100 }.upper_bound();
        assert!((bound - (1.0 - 0.05_f64.powf(0.01))).abs() < 1e-9, "{bound}");
        assert_eq!(Proportion { hits: 0, of: 100 }.interval()[0].to_bits(), 0.0_f64.to_bits());
        assert_eq!(Proportion { hits: 7, of: 7 }.interval()[1].to_bits(), 1.0_f64.to_bits());
    }

    #[test]
    fn only_what_is_hardly_chance_is_above() {
        assert!(!Proportion { hits: 3, of: 100 }.is_above(0.01));
        assert!(Proportion { hits: 6, of: 100 }.is_above(0.01));
    }

    #[test]
    fn a_rate_is_compatible_within_the_exact_bounds_of_its_error() {
        let half = Proportion { hits: 5, of: 10 };
        assert!((half.rate() - 0.5).abs() < f64::EPSILON);
        // Clopper and Pearson: 0.187 to 0.813.
        assert_eq!(
            [0.18, 0.19, 0.81, 0.82].map(|rate| half.is_compatible_with(rate, 0.05)),
            [false, true, true, false]
        );
    }
}
