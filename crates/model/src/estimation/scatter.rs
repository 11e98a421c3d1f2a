//! Are residuals noise? Histogram and normal plot of residuals in units of the noise, as numbers to be drawn.

use hexbench_core::NumberKind;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::estimation::residuals::Residual;

/// Width of a class, standard deviations of one reading.
const CLASS: f64 = 0.5;
/// Classes on each side of zero; residuals beyond count in the outermost one.
const CLASSES: usize = 12;
/// Most quantiles.
const QUANTILES: usize = 60;

/// Whitened residuals of all readings and coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ResidualScatter {
    sorted: Vec<f64>,
}

impl ResidualScatter {
    /// Of these readings.
    pub fn of(readings: &[Residual]) -> Self {
        let read = |r: &Residual| {
            let (whitened, kinds) = (r.whitened, r.kinds);
            (0..6).filter(move |&k| kinds[k] != NumberKind::Unread).map(move |k| whitened[k])
        };
        let mut sorted: Vec<f64> = readings.iter().flat_map(read).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        Self { sorted }
    }

    /// Outline of the histogram: residual in units of the noise, share of residuals per unit.
    pub fn histogram(&self) -> Vec<[f64; 2]> {
        let n = self.sorted.len().max(1) as f64;
        let edge = |k: usize| CLASS * (k as f64 - CLASSES as f64);
        let below = |k: usize| match k {
            0 => 0,
            _ if k == 2 * CLASSES => self.sorted.len(),
            _ => self.sorted.partition_point(|x| *x < edge(k)),
        };
        let step = |k: usize| {
            let share = (below(k + 1) - below(k)) as f64 / n / CLASS;
            [[edge(k), share], [edge(k + 1), share]]
        };
        (0..2 * CLASSES).flat_map(step).collect()
    }

    /// Normal plot: what noise alone would give, what was found. Both ends are kept: outliers are what the plot is for.
    pub fn quantiles(&self) -> Vec<[f64; 2]> {
        let n = self.sorted.len();
        let law = Normal::standard();
        let count = QUANTILES.min(n);
        let at = |k: usize| {
            let i = if count > 1 { k * (n - 1) / (count - 1) } else { 0 };
            [law.inverse_cdf((i as f64 + 0.5) / n as f64), self.sorted[i]]
        };
        (0..count).map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexbench_core::Vector6;

    fn scatter(values: &[f64]) -> ResidualScatter {
        let residual = |(row, chunk): (usize, &[f64])| {
            let whitened = Vector6::from_column_slice(chunk);
            Residual {
                kinds: [hexbench_core::NumberKind::Length; 6],
                row,
                condition: row,
                value: whitened,
                whitened,
            }
        };
        ResidualScatter::of(&values.chunks_exact(6).enumerate().map(residual).collect::<Vec<_>>())
    }

    #[test]
    fn the_histogram_holds_every_residual_once() {
        let outline = scatter(&[-40.0, -6.0, -0.25, 0.0, 0.25, 40.0]).histogram();
        let area: f64 = outline.chunks_exact(2).map(|e| (e[1][0] - e[0][0]) * e[0][1]).sum();
        assert!((area - 1.0).abs() < 1e-12, "{area}");
        assert!(outline[0][1] > 0.0 && outline[outline.len() - 1][1] > 0.0, "what is far out is not lost");
    }

    #[test]
    fn the_normal_plot_keeps_both_ends_and_its_order() {
        let values: Vec<f64> = (0..600).map(|k| f64::from(k) - 300.0).collect();
        let points = scatter(&values).quantiles();
        assert_eq!(points.len(), QUANTILES);
        let ends = [points[0][1], points[QUANTILES - 1][1]];
        assert!((ends[0] + 300.0).abs() < 1e-9 && (ends[1] - 299.0).abs() < 1e-9, "{ends:?}");
        assert!(points.windows(2).all(|w| w[0][0] < w[1][0]));
    }
}
