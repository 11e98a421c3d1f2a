//! Periods worth trying in a periodogram over leg length.

use crate::campaign::Condition;

/// Most periods tried.
const MOST_PERIODS: usize = 1200;
/// Periods tried go down to this share of the mean spacing between lengths: lengths that are not evenly spaced have no
/// Nyquist limit, and a pitch of a millimetre must be found in 40 lengths over 200 mm.
const FINER_THAN_SPACING: usize = 6;
/// Frequency steps per resolution element `1 / range`.
const OVERSAMPLING: usize = 4;

/// Periods (m) from the largest travel of a leg down to a sixth of the mean spacing between lengths, equally spaced in
/// frequency.
/// Each leg has a phase of its own, so how much longer one leg is than another does not matter.
/// Source: Scargle 1982, Astrophys. J. 263 (sampling of a periodogram).
pub(crate) fn period_grid(conditions: &[Condition]) -> Vec<f64> {
    let range = (0..6).map(|leg| travel(conditions, leg)).fold(0.0, f64::max);
    if !range.is_finite() || range < 1e-6 {
        return Vec::new();
    }
    let step = 1.0 / (OVERSAMPLING as f64 * range);
    let count = FINER_THAN_SPACING * OVERSAMPLING * distinct_lengths(conditions);
    let count = count.clamp(8, MOST_PERIODS);
    (OVERSAMPLING..OVERSAMPLING + count).map(|k| 1.0 / (step * k as f64)).collect()
}

fn travel(conditions: &[Condition], leg: usize) -> f64 {
    let lengths = conditions.iter().map(|c| c.commanded_lengths[leg]);
    let (low, high) = lengths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| (a.min(q), b.max(q)));
    high - low
}

fn distinct_lengths(conditions: &[Condition]) -> usize {
    let mut lengths: Vec<u64> = conditions.iter().map(|c| c.commanded_lengths[0].to_bits()).collect();
    lengths.sort_unstable();
    lengths.dedup();
    lengths.len()
}
