//! Periods worth trying in a periodogram over leg length.

use std::f64::consts::TAU;

use hexbench_core::Vector6;

use crate::estimation::campaign::Condition;

/// Shortest lead of a screw in use, m: nothing finer is looked for.
const FINEST_PERIOD_M: f64 = 0.5e-3;
/// Most periods tried.
const MOST_PERIODS: usize = 3000;
/// Frequency steps per resolution element `1 / range`.
const OVERSAMPLING: usize = 4;

/// Periods (m), equally spaced in frequency: from the whole range of commanded leg lengths down to a quarter of the mean spacing
/// of all lengths or the finest lead. Lengths at irregular places tell apart waves far shorter than their spacing in one leg.
/// Source: Scargle 1982, Astrophys. J. 263 (sampling of a periodogram).
pub(crate) fn period_grid(conditions: &[Condition]) -> Vec<f64> {
    let mut lengths: Vec<f64> = conditions.iter().flat_map(|c| c.commanded_lengths.data.0[0]).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    lengths.dedup();
    let range = lengths.last().zip(lengths.first()).map_or(0.0, |(high, low)| high - low);
    if !range.is_finite() || range < 1e-6 {
        return Vec::new();
    }
    let finest = FINEST_PERIOD_M.max(range / (4 * lengths.len()) as f64);
    let periods = (OVERSAMPLING..).map(|k| OVERSAMPLING as f64 * range / k as f64);
    periods.take(MOST_PERIODS).take_while(|&p| p >= finest).collect()
}

/// Sine and cosine of every length, in periods.
pub(crate) fn waves(lengths: &Vector6, period: f64) -> [Vector6; 2] {
    let mut both = [Vector6::zeros(); 2];
    for leg in 0..6 {
        (both[0][leg], both[1][leg]) = (TAU * lengths[leg] / period).sin_cos();
    }
    both
}

/// Sines and cosines at many periods, by turning those of the first: an addition in frequency is a turn of the angle.
pub(crate) struct Turned {
    first: f64,
    /// Period of the step in frequency from one to the next.
    step: f64,
}

/// Periods until which rounding of the turns stays below 1e-14.
pub(crate) const TURNS: usize = 32;
/// Relative difference of steps in frequency that are equal.
const EQUAL_STEPS: f64 = 1e-9;

impl Turned {
    /// For periods equally spaced in frequency, [`TURNS`] of them at most; none for others.
    pub(crate) fn of(periods: &[f64]) -> Option<Self> {
        let (&first, second) = (periods.first()?, *periods.get(1)?);
        let step = second.recip() - first.recip();
        let is_next =
            |pair: &[f64]| (pair[1].recip() - pair[0].recip() - step).abs() <= EQUAL_STEPS * step.abs();
        (step != 0.0 && periods.len() <= TURNS && periods.windows(2).all(is_next))
            .then(|| Self { first, step: step.recip() })
    }

    /// `put(k, [sine, cosine])` of every leg for the k-th of so many periods, from what a period has `at` a condition.
    pub(crate) fn each(
        &self,
        periods: usize,
        at: impl Fn(f64) -> [Vector6; 2],
        mut put: impl FnMut(usize, [Vector6; 2]),
    ) {
        let ([mut sine, mut cosine], turn) = (at(self.first), at(self.step));
        for k in 0..periods {
            put(k, [sine, cosine]);
            (sine, cosine) = (
                sine.component_mul(&turn[1]) + cosine.component_mul(&turn[0]),
                cosine.component_mul(&turn[1]) - sine.component_mul(&turn[0]),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turned_waves_are_those_of_every_period() {
        let periods: Vec<f64> = (40..40 + TURNS).map(|k| 0.2 / k as f64).collect();
        let lengths = Vector6::from_fn(|leg, _| 0.173 + 0.01 * leg as f64);
        let at = |period: f64| waves(&lengths, period);
        let turned = Turned::of(&periods).map(|turned| {
            turned.each(periods.len(), at, |k, found| {
                let expected = at(periods[k]);
                for part in 0..2 {
                    assert!((found[part] - expected[part]).amax() < 1e-12, "{k}: {found:?} {expected:?}");
                }
            });
        });
        assert!(turned.is_some());
        assert!(Turned::of(&[1.0]).is_none());
        assert!(Turned::of(&[1.0, 0.5, 0.3]).is_none());
    }
}
