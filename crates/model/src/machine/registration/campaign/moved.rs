//! Balls that moved on the platform between two records: distances that a rigid platform keeps.

use hexbench_core::{BallPlace, BallRecord, Vector3};

use super::super::{DistanceResidual, Places, distances};
use super::Pair;

/// A change of a distance by so many standard deviations.
const MOVED_SIGMAS: f64 = 5.0;

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
        let changes = distances(&touched(before), &touched(after));
        // The difference of two distances has four times the variance of a coordinate.
        let limit = MOVED_SIGMAS * 2.0 * sigma;
        let largest = changes.iter().map(|change| change.residual.abs()).fold(0.0, f64::max);
        if sigma <= 0.0 || largest < limit {
            return None;
        }
        Some(MovedBall {
            line: pair.load.line,
            records: [before.id.clone(), after.id.clone()],
            balls: suspects(&changes, balls, limit),
            change: largest,
        })
    })
}

/// Balls whose own distances alone have changed; all that a change touches where several moved.
fn suspects(changes: &[DistanceResidual], balls: &[BallPlace], limit: f64) -> Vec<String> {
    let changed: Vec<_> = changes.iter().filter(|change| change.residual.abs() > limit).collect();
    let of = |change: &DistanceResidual, k: usize| change.first == k || change.second == k;
    let named = |is_one: &dyn Fn(usize) -> bool| -> Vec<String> {
        (0..balls.len()).filter(|k| is_one(*k)).map(|k| balls[k].ball.clone()).collect()
    };
    let alone = named(&|k| changed.iter().all(|change| of(change, k)));
    if alone.is_empty() { named(&|k| changed.iter().any(|change| of(change, k))) } else { alone }
}
