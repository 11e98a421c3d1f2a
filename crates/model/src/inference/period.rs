//! Periods worth trying in a periodogram over leg length.

use crate::estimation::campaign::Condition;

/// Shortest lead of a screw in use, m: nothing finer is looked for.
const FINEST_PERIOD_M: f64 = 0.5e-3;
/// Most periods tried.
const MOST_PERIODS: usize = 1500;
/// Frequency steps per resolution element `1 / range`.
const OVERSAMPLING: usize = 4;

/// Periods (m), equally spaced in frequency: from the whole range of commanded leg lengths down to half the mean spacing of
/// all lengths or the finest lead. Lengths at irregular places tell apart waves far shorter than their spacing in one leg.
/// Source: Scargle 1982, Astrophys. J. 263 (sampling of a periodogram).
pub(crate) fn period_grid(conditions: &[Condition]) -> Vec<f64> {
    let mut lengths: Vec<f64> = conditions.iter().flat_map(|c| c.commanded_lengths.data.0[0]).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    lengths.dedup();
    let range = lengths.last().zip(lengths.first()).map_or(0.0, |(high, low)| high - low);
    if !range.is_finite() || range < 1e-6 {
        return Vec::new();
    }
    let finest = FINEST_PERIOD_M.max(range / (2 * lengths.len()) as f64);
    let periods = (OVERSAMPLING..).map(|k| OVERSAMPLING as f64 * range / k as f64);
    periods.take(MOST_PERIODS).take_while(|&p| p >= finest).collect()
}
