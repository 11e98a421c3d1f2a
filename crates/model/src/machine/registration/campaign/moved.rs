//! Balls that moved on the platform between two records: distances that a rigid platform keeps.

use hexbench_core::{BallPlace, BallRecord, Vector3};

use super::super::{Places, distances};
use super::Pair;

/// A change of a distance by so many standard deviations.
const MOVED_SIGMAS: f64 = 5.0;
/// A second ball whose distances changed by this share of those of the first may as well be the one that moved.
const AS_MUCH: f64 = 0.7;

/// A ball that moved.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedBall {
    /// Line of the loads.
    pub line: u64,
    /// Reference record and loaded record.
    pub records: [String; 2],
    /// The ball; two where the distances do not tell which.
    pub balls: Vec<String>,
    /// Largest change of a distance, m.
    pub change: f64,
}

/// The ball that moved between the records of a row; `sigma` is that of one coordinate, m.
pub(super) fn between(
    records: &[BallRecord],
    places: &Places,
    pair: &Pair<'_>,
    sigma: f64,
) -> Option<MovedBall> {
    let [before, after] = [pair.reference?, pair.loaded].map(|k| &records[k]);
    [&places.platform, &places.base].into_iter().find_map(|balls| {
        let touched = |record: &BallRecord| -> Vec<Vector3> {
            balls.iter().filter_map(|place| record.centre(&place.ball)).collect()
        };
        let (sums, change) = changes(&touched(before), &touched(after));
        // The difference of two distances has four times the variance of a coordinate.
        if sigma <= 0.0 || change.abs() < MOVED_SIGMAS * 2.0 * sigma {
            return None;
        }
        Some(MovedBall {
            line: pair.load.line,
            records: [before.id.clone(), after.id.clone()],
            balls: suspects(&sums, balls),
            change,
        })
    })
}

/// Sum of squared changes of the distances of every ball, and the largest change.
fn changes(before: &[Vector3], after: &[Vector3]) -> (Vec<f64>, f64) {
    let mut sums = vec![0.0; before.len()];
    let mut largest: f64 = 0.0;
    for change in distances(before, after) {
        sums[change.first] += change.residual.powi(2);
        sums[change.second] += change.residual.powi(2);
        if change.residual.abs() > largest.abs() {
            largest = change.residual;
        }
    }
    (sums, largest)
}

fn suspects(sums: &[f64], balls: &[BallPlace]) -> Vec<String> {
    let most = sums.iter().copied().fold(0.0, f64::max);
    let moved = sums.iter().zip(balls).filter(|(sum, _)| **sum > AS_MUCH * most);
    moved.map(|(_, place)| place.ball.clone()).collect()
}
