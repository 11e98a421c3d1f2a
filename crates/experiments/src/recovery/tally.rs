//! Counting intervals that cover the truth, with the bounds that chance allows.

use hexbench_core::statistics::COVERAGE_FACTOR;
use serde::{Deserialize, Serialize};
use statrs::distribution::{Binomial, DiscreteCDF};

/// Coverage of such an interval.
pub const NOMINAL: f64 = 0.95;
/// Chance that right intervals break a bound: for 2000 campaigns they are 0.9335 and 0.9655. Where a table has a row for each
/// of many subjects, it is divided among them (Bonferroni), so that a whole column breaks with this chance.
pub const CHANCE: f64 = 1e-3;

/// Pulls of a kind of numbers, counted campaign by campaign.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    campaigns: u64,
    intervals: u64,
    covered: u64,
    sum: f64,
    squares: f64,
}

impl Tally {
    /// The pulls of one campaign; without any, it does not count.
    pub fn campaign(pulls: impl IntoIterator<Item = f64>) -> Self {
        let mut tally = Self::default();
        for z in pulls {
            tally.intervals += 1;
            tally.covered += u64::from(z.abs() <= COVERAGE_FACTOR);
            tally.sum += z;
            tally.squares += z * z;
        }
        tally.campaigns = u64::from(tally.intervals > 0);
        tally
    }

    /// One interval that covers or does not; its pull is not known.
    pub fn interval(covers: bool) -> Self {
        Self { campaigns: 1, intervals: 1, covered: u64::from(covers), sum: 0.0, squares: 1.0 }
    }

    /// Both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            campaigns: self.campaigns + other.campaigns,
            intervals: self.intervals + other.intervals,
            covered: self.covered + other.covered,
            sum: self.sum + other.sum,
            squares: self.squares + other.squares,
        }
    }

    /// What was found, as one of so many rows; `None` without intervals.
    pub fn coverage(self, rows: usize) -> Option<Coverage> {
        let n = self.intervals as f64;
        let mean = self.sum / n;
        let [low, high] = bounds(self.campaigns, NOMINAL, rows);
        (self.intervals > 0).then(|| Coverage {
            campaigns: self.campaigns,
            intervals: self.intervals,
            share: self.covered as f64 / n,
            low,
            high,
            mean_pull: mean,
            sd_pull: (self.squares / n - mean * mean).max(0.0).sqrt(),
        })
    }
}

impl std::iter::Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Self::and)
    }
}

/// Share of intervals that cover, with its bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coverage {
    /// Campaigns behind it.
    pub campaigns: u64,
    /// Intervals counted; those of one campaign are not independent.
    pub intervals: u64,
    /// Share that covers the truth.
    pub share: f64,
    /// Smallest share that chance allows for this many campaigns.
    pub low: f64,
    /// Largest share that chance allows.
    pub high: f64,
    /// Mean pull; 0 for an unbiased estimate.
    pub mean_pull: f64,
    /// Standard deviation of the pulls; 1 for honest uncertainties.
    pub sd_pull: f64,
}

impl Coverage {
    /// True when the share lies within its bounds.
    pub fn holds(&self) -> bool {
        (self.low..=self.high).contains(&self.share)
    }
}

/// Shares between which `n` independent trials of a probability fall but for [`CHANCE`] over the number of rows. Intervals of
/// one campaign share its noise: counting each campaign once makes these bounds the widest that can be needed.
pub fn bounds(n: u64, probability: f64, rows: usize) -> [f64; 2] {
    let Ok(law) = Binomial::new(probability, n.max(1)) else { return [0.0, 1.0] };
    let share = |p: f64| law.inverse_cdf(p) as f64 / n.max(1) as f64;
    let tail = 0.5 * CHANCE / rows.max(1) as f64;
    [share(tail), share(1.0 - tail)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_of_two_thousand_campaigns_are_those_of_the_binomial_law() {
        let [low, high] = bounds(2000, NOMINAL, 1);
        assert!((low - 0.9335).abs() < 1e-3 && (high - 0.9655).abs() < 1e-3, "{low} {high}");
    }

    #[test]
    fn campaigns_without_intervals_do_not_count() {
        let all: Tally = [Tally::campaign([0.5, -3.0]), Tally::campaign([])].into_iter().sum();
        let found = all.coverage(1).unwrap();
        assert_eq!((found.campaigns, found.intervals, found.share), (1, 2, 0.5));
        assert!(Tally::default().coverage(1).is_none());
    }
}
