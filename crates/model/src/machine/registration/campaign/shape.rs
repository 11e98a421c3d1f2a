//! Where balls are that nobody has measured: as the commanded poses put them, in the shape that the records agree upon.

use hexbench_core::statistics::median;
use hexbench_core::{BallPlace, BallRecord, Pose, Vector3};

use super::super::{Places, rigid};
use super::{BallCampaignError, Pair};

/// Rounds in which shape and poses settle; each takes the error of the shape down by the square of what the poses are off.
const ROUNDS: usize = 4;

/// Places of the balls as the commanded poses of the reference records have them.
pub(super) fn by_commands(records: &[BallRecord], pairs: &[Pair<'_>]) -> Result<Places, BallCampaignError> {
    let references: Vec<(&BallRecord, &Pose)> =
        pairs.iter().filter_map(|p| Some((&records[p.reference?], &p.row.pose))).collect();
    let Some((first, _)) = references.first() else { return Err(BallCampaignError::NoPlaces) };
    let mut platform: Vec<BallPlace> =
        first.balls.iter().map(|ball| place(&ball.ball, &references)).collect();
    let used: Vec<&BallRecord> =
        pairs.iter().flat_map(|p| p.reference.into_iter().chain([p.loaded])).map(|k| &records[k]).collect();
    for _ in 0..ROUNDS {
        agree(&mut platform, &used);
    }
    Ok(Places { platform, base: Vec::new(), origin: Vector3::zeros(), measured: false })
}

fn place(ball: &str, references: &[(&BallRecord, &Pose)]) -> BallPlace {
    let seen = references.iter().filter_map(|(record, pose)| {
        Some(pose.rotation().transpose() * (record.centre(ball)? - pose.translation))
    });
    BallPlace { ball: ball.to_owned(), centre: middle(&seen.collect::<Vec<_>>()) }
}

/// Moves the places to the shape of most records; where they stand on the platform stays.
fn agree(places: &mut [BallPlace], records: &[&BallRecord]) {
    let known: Vec<Vector3> = places.iter().map(|place| place.centre).collect();
    let mut left = vec![Vec::new(); places.len()];
    for record in records {
        let touched: Vec<Vector3> = places.iter().filter_map(|place| record.centre(&place.ball)).collect();
        let Some(fit) = rigid(&known, &touched) else { continue };
        for (own, residual) in left.iter_mut().zip(&fit.residuals) {
            own.push(fit.rotation.transpose() * residual);
        }
    }
    for (place, residuals) in places.iter_mut().zip(&left) {
        place.centre += middle(residuals);
    }
}

/// Median of every coordinate, so that some wrong records do not count.
fn middle(points: &[Vector3]) -> Vector3 {
    Vector3::from_fn(|k, _| median(points.iter().map(|p| p[k])).unwrap_or_default())
}
