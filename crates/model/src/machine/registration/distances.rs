//! Distances between balls: what a rigid platform keeps, whatever its pose.

use hexbench_core::Vector3;

/// A distance between two balls as measured minus as known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistanceResidual {
    /// First ball, from 0.
    pub first: usize,
    /// Second ball, from 0.
    pub second: usize,
    /// Measured minus known distance, m.
    pub residual: f64,
}

/// All pairs of balls. The standard deviation of a residual is `sqrt(2)` times that of a coordinate.
pub fn distances(known: &[Vector3], measured: &[Vector3]) -> Vec<DistanceResidual> {
    let count = known.len().min(measured.len());
    let pairs = (0..count).flat_map(|first| (first + 1..count).map(move |second| (first, second)));
    let apart = |points: &[Vector3], i: usize, j: usize| (points[i] - points[j]).norm();
    pairs
        .map(|(first, second)| DistanceResidual {
            first,
            second,
            residual: apart(measured, first, second) - apart(known, first, second),
        })
        .collect()
}
