//! Points spread over the ranges of numeric axes: instead of every combination of values, each point has a value of its own on every
//! ranged axis.
//!
//! ```text
//! sobol              x_i = scrambled Sobol sequence (Sobol 1967; Owen 1995, Burley 2020): even in all axes together
//! latin-hypercube    x_i = (p_i + u_i) / n, p a permutation of 0 .. n-1 for each axis (McKay, Beckman and Conover 1979)
//! ```

use hexbench_core::words::to_digits;
use rand::RngExt;
use rand::seq::SliceRandom;
use sobol_burley::sample;

use super::draw::{SweepPurpose, generator};

/// How points are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointKind {
    /// A scrambled Sobol sequence.
    Sobol,
    /// One point in each of as many equal parts of every axis.
    LatinHypercube,
}

hexbench_core::worded! {
    /// Name in the study file.
    PointKind::name {
        Sobol => "sobol",
        LatinHypercube => "latin-hypercube",
    }
}

/// Points over ranges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointDesign {
    /// How they are spread.
    pub kind: PointKind,
    /// How many.
    pub points: usize,
    /// Seed of the study.
    pub seed: u64,
}

/// A range of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisRange {
    /// The smallest value.
    pub from: f64,
    /// The largest.
    pub to: f64,
    /// Even in the logarithm.
    pub is_log: bool,
}

impl PointDesign {
    /// The coordinates of all points in a dimension, from 0 to 1.
    fn unit(&self, dimension: usize) -> Vec<f64> {
        let mut rng = generator(self.seed, SweepPurpose::Points, dimension, 0);
        match self.kind {
            PointKind::Sobol => {
                // All dimensions of one sequence have one seed.
                let seed: u32 = generator(self.seed, SweepPurpose::Points, 0, 0).random();
                let dimension = u32::try_from(dimension).unwrap_or(0);
                (0..).take(self.points).map(|i| f64::from(sample(i, dimension, seed))).collect()
            }
            PointKind::LatinHypercube => {
                let mut parts: Vec<usize> = (0..self.points).collect();
                parts.shuffle(&mut rng);
                let within = |part: usize| (part as f64 + rng.random::<f64>()) / self.points as f64;
                parts.into_iter().map(within).collect()
            }
        }
    }

    /// Values of all points on the axis of a dimension, to four digits.
    pub fn numbers(&self, dimension: usize, range: AxisRange) -> Vec<f64> {
        let AxisRange { from, to, is_log } = range;
        let value = |x: f64| {
            let value = if is_log { from * (to / from).powf(x) } else { from + (to - from) * x };
            to_digits(value, 4).clamp(from, to)
        };
        self.unit(dimension).into_iter().map(value).collect()
    }

    /// The same in whole numbers, each as often as the others; even in the logarithm where the range is.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between two whole numbers from 1 that the reader has checked"
    )]
    pub fn whole(&self, dimension: usize, range: AxisRange) -> Vec<u64> {
        let AxisRange { from, to, is_log } = range;
        let value = |x: f64| {
            let value = if is_log {
                (from - 0.5) * ((to + 0.5) / (from - 0.5)).powf(x) + 0.5
            } else {
                from + (to + 1.0 - from) * x
            };
            value.floor().clamp(from, to) as u64
        };
        self.unit(dimension).into_iter().map(value).collect()
    }
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers from 0 to a few")]
mod tests {
    use super::*;

    const POINTS: usize = 64;

    fn design(kind: PointKind) -> PointDesign {
        PointDesign { kind, points: POINTS, seed: 5 }
    }

    #[test]
    fn a_latin_hypercube_has_a_point_in_every_part_of_every_axis() {
        for dimension in 0..4 {
            let mut parts: Vec<usize> = design(PointKind::LatinHypercube)
                .unit(dimension)
                .iter()
                .map(|x| (x * POINTS as f64) as usize)
                .collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..POINTS).collect::<Vec<_>>(), "axis {dimension}");
        }
    }

    /// The net property: of 64 points one lies in each of the 64 boxes of any shape 2^-a x 2^-b with a + b = 6.
    #[test]
    fn a_sobol_sequence_fills_all_boxes_of_two_axes() {
        let [x, y] = [0, 1].map(|k| design(PointKind::Sobol).unit(k));
        for a in 0..=6_u32 {
            let (columns, rows) = (1_usize << a, 1_usize << (6 - a));
            let mut boxes: Vec<usize> = x
                .iter()
                .zip(&y)
                .map(|(x, y)| (x * columns as f64) as usize * rows + (y * rows as f64) as usize)
                .collect();
            boxes.sort_unstable();
            assert_eq!(boxes, (0..POINTS).collect::<Vec<_>>(), "{columns} x {rows} boxes");
        }
    }

    #[test]
    fn values_lie_within_their_range_and_more_points_begin_with_the_fewer() {
        let range = AxisRange { from: 0.5, to: 8.0, is_log: true };
        let few = PointDesign { points: 16, ..design(PointKind::Sobol) }.numbers(2, range);
        let many = design(PointKind::Sobol).numbers(2, range);
        assert_eq!(few, many[..16]);
        // Half of the points lie below the geometric middle, 2.
        assert_eq!(many.iter().filter(|x| **x < 2.0).count(), POINTS / 2);
        assert!(many.iter().all(|x| (0.5..=8.0).contains(x)), "{many:?}");
    }

    #[test]
    fn whole_numbers_are_all_met_equally_often() {
        let whole =
            design(PointKind::LatinHypercube).whole(0, AxisRange { from: 3.0, to: 6.0, is_log: false });
        for n in 3..=6 {
            assert_eq!(whole.iter().filter(|x| **x == n).count(), POINTS / 4, "{n}");
        }
        let log =
            design(PointKind::LatinHypercube).whole(0, AxisRange { from: 1.0, to: 100.0, is_log: true });
        assert!(log.iter().filter(|x| **x <= 10).count() > POINTS / 3, "{log:?}");
    }

    #[test]
    fn another_seed_gives_other_points() {
        let range = AxisRange { from: 0.0, to: 1.0, is_log: false };
        for kind in PointKind::ALL {
            let other = PointDesign { seed: 6, ..design(kind) };
            assert_ne!(design(kind).numbers(0, range), other.numbers(0, range));
            assert_ne!(design(kind).numbers(0, range), design(kind).numbers(1, range));
        }
    }
}
