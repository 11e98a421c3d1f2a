//! Statistics of samples, defined once for the whole workspace.
//!
//! | statistic | definition |
//! |---|---|
//! | mean | `sum x / n` |
//! | root mean square | `sqrt(sum x^2 / n)` |
//! | standard deviation | `sqrt(sum (x - mean)^2 / (n - 1))` |
//! | quantile of a share `p` | linear between the order statistics at `(n - 1) p`, counted from 0 |
//! | median | quantile of one half: the middle value, or the mean of the two middle ones |
//! | bounds of a proportion | exact binomial, see [`Proportion`] |
//!
//! The quantile is type 7 of Hyndman and Fan 1996, The American Statistician 50, 361: what `numpy.quantile` and R give unless
//! asked for another (statrs gives type 8). Of nothing there is no statistic: `None`.

mod clustered;
mod proportion;
mod welford;

pub use clustered::ClusteredShare;
pub use proportion::Proportion;
pub use welford::Welford;

/// Half-width of a 95 % interval of a normal law in standard deviations.
pub const COVERAGE_FACTOR: f64 = 1.959_963_984_540_054;

/// Arithmetic mean; `None` of nothing.
pub fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.into_iter().fold((0.0, 0_usize), |(sum, count), x| (sum + x, count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// Root mean square; `None` of nothing.
pub fn root_mean_square(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    mean(values.into_iter().map(|x| x * x)).map(f64::sqrt)
}

/// Standard deviation of a sample, with `n - 1`; `None` of fewer than two values.
pub fn standard_deviation(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let all: Vec<f64> = values.into_iter().collect();
    let center = mean(all.iter().copied()).filter(|_| all.len() > 1)?;
    let squares: f64 = all.iter().map(|x| (x - center).powi(2)).sum();
    Some((squares / (all.len() - 1) as f64).sqrt())
}

/// Median; `None` of nothing.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut all: Vec<f64> = values.into_iter().collect();
    let (middle, is_even) = (all.len() / 2, all.len().is_multiple_of(2));
    if all.is_empty() {
        return None;
    }
    let (below, high, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
    let low = if is_even { below.iter().copied().max_by(f64::total_cmp)? } else { *high };
    Some(f64::midpoint(low, *high))
}

/// Value below which a share of the sample lies (0 to 1; beyond, the smallest or largest value); `None` of nothing.
pub fn quantile(values: impl IntoIterator<Item = f64>, share: f64) -> Option<f64> {
    let all = sorted(values);
    let place = share.clamp(0.0, 1.0) * all.len().saturating_sub(1) as f64;
    // A place in the sample becomes an index once it is cut.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the count")]
    let index = place.floor() as usize;
    let low = *all.get(index)?;
    let high = all.get(index + 1).copied().unwrap_or(low);
    Some(low + place.fract() * (high - low))
}

fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.into_iter().collect();
    all.sort_unstable_by(f64::total_cmp);
    all
}

#[cfg(test)]
mod tests;
