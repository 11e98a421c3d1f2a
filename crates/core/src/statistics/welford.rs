//! Statistics of numbers as they come.

/// Mean and spread of numbers as they come. Source: Welford, Technometrics 4 (1962) 419.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Welford {
    count: u64,
    mean: f64,
    squares: f64,
}

impl Welford {
    /// Takes a number in.
    pub fn add(&mut self, x: f64) {
        self.count += 1;
        let before = x - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (x - self.mean);
    }

    /// Both sets of numbers. Source: Chan, Golub and `LeVeque`, The American Statistician 37 (1983) 242.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let count = self.count + other.count;
        if other.count == 0 || count == 0 {
            return self;
        }
        let (n, m, apart) = (self.count as f64, other.count as f64, other.mean - self.mean);
        let all = count as f64;
        Self {
            count,
            mean: self.mean + apart * m / all,
            squares: self.squares + other.squares + apart * apart * n * m / all,
        }
    }

    /// How many numbers it has seen.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean; NaN of nothing.
    pub fn mean(&self) -> f64 {
        if self.count == 0 { f64::NAN } else { self.mean }
    }

    /// Sum of squared deviations from the mean.
    pub fn sum_of_squares(&self) -> f64 {
        self.squares
    }

    /// Standard deviation of the sample; NaN of fewer than two.
    pub fn std(&self) -> f64 {
        if self.count < 2 { f64::NAN } else { (self.squares / (self.count - 1) as f64).sqrt() }
    }

    /// Root mean square; NaN of nothing.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count as f64 + self.mean() * self.mean()).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::Welford;

    #[test]
    fn running_statistics_are_those_of_the_textbook() {
        // Ten numbers far from zero: the naive sum of squares loses eight digits here.
        const BASE: f64 = 1e8;
        let mut all = Welford::default();
        (1..=10).for_each(|k| all.add(BASE + f64::from(k)));
        assert!((all.mean() - (BASE + 5.5)).abs() < 1e-7, "{}", all.mean());
        let std = (82.5_f64 / 9.0).sqrt();
        assert!((all.std() - std).abs() < 1e-7 * std, "{}", all.std());
        let mut small = Welford::default();
        small.add(3.0);
        small.add(-4.0);
        assert!((small.rms() - 12.5_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn statistics_of_parts_together_are_those_of_the_whole() {
        let of = |range: std::ops::Range<i32>| {
            let mut all = Welford::default();
            range.for_each(|k| all.add(f64::from(k * k)));
            all
        };
        let (whole, parts) = (of(0..9), of(0..0).and(of(0..4)).and(of(4..9)).and(of(0..0)));
        assert_eq!(whole.count(), parts.count());
        assert!((whole.mean() - parts.mean()).abs() < 1e-13, "{} {}", whole.mean(), parts.mean());
        assert!((whole.std() - parts.std()).abs() < 1e-13, "{} {}", whole.std(), parts.std());
    }

    #[test]
    fn nothing_has_no_mean() {
        assert!(Welford::default().mean().is_nan() && Welford::default().rms().is_nan());
    }

    #[test]
    fn squares_are_those_of_the_deviations_from_the_mean() {
        let mut all = Welford::default();
        for x in [1.0, 2.0, 6.0] {
            all.add(x);
        }
        assert!((all.sum_of_squares() - 14.0).abs() < 1e-12);
    }
}
