//! Periods worth trying in a periodogram over leg length.

use crate::campaign::Condition;

/// Most periods tried.
const MOST_PERIODS: usize = 400;
/// Frequency steps per resolution element `1 / range`.
const OVERSAMPLING: usize = 4;

/// Periods (m) from the whole range of commanded leg lengths down to the mean spacing between lengths, equally spaced
/// in frequency. Source: Scargle 1982, Astrophys. J. 263 (sampling of a periodogram).
pub(crate) fn period_grid(conditions: &[Condition]) -> Vec<f64> {
    let lengths = conditions.iter().flat_map(|c| c.commanded_lengths.iter().copied().collect::<Vec<_>>());
    let (low, high) = lengths.fold((f64::INFINITY, 0.0_f64), |(a, b), q| (a.min(q), b.max(q)));
    let range = high - low;
    if !range.is_finite() || range < 1e-6 {
        return Vec::new();
    }
    let step = 1.0 / (OVERSAMPLING as f64 * range);
    let count = distinct_lengths(conditions).saturating_mul(2).clamp(8, MOST_PERIODS);
    (OVERSAMPLING..OVERSAMPLING + count).map(|k| 1.0 / (step * k as f64)).collect()
}

fn distinct_lengths(conditions: &[Condition]) -> usize {
    let mut lengths: Vec<u64> = conditions.iter().map(|c| c.commanded_lengths[0].to_bits()).collect();
    lengths.sort_unstable();
    lengths.dedup();
    OVERSAMPLING * lengths.len()
}
