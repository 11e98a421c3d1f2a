//! Readings of a space to choose from, in round numbers.

use std::sync::Arc;

use hexbench_core::{Hexapod, Observation, Pose};
use hexbench_model::effects::term::{Need, Term};
use hexbench_model::results::next::{snapped, step};

use crate::regressor::reading;
use crate::space::Conditions;
use crate::{DesignError, Space};

/// Readings tried, about.
const MOST_READINGS: usize = 1200;
/// Poses tried, at least and at most.
const POSES: [usize; 2] = [12, 60];

/// Poses of the space, each coordinate round, under every setting: the middle, the ends of every coordinate, and poses all over.
/// Conditions vary where one of the terms depends on them.
///
/// # Errors
/// [`DesignError::NoPose`].
pub fn candidate_readings(
    space: &Space,
    hexapod: &Hexapod,
    terms: &[Arc<dyn Term>],
    seed: u32,
) -> Result<Vec<Observation>, DesignError> {
    let settings = Space { conditions: conditions(space, terms), ..space.clone() }.settings();
    let [fewest, most] = POSES;
    let count = (MOST_READINGS / settings.len().max(1)).clamp(fewest, most);
    let mut poses: Vec<Pose> = Vec::new();
    let drawn = space.poses(hexapod, count, seed)?;
    for pose in ends(space).into_iter().chain(drawn.iter().copied()) {
        let pose = round(space, &pose);
        let kept = space.worst_limit(hexapod, &pose).is_none_or(|l| l.excess <= 0.0);
        if kept && poses.len() < count && !poses.contains(&pose) {
            poses.push(pose);
        }
    }
    if poses.is_empty() {
        poses = drawn;
    }
    Ok(poses.iter().flat_map(|p| settings.iter().map(|s| reading(*p, s))).collect())
}

/// All conditions that matter to a term; of the others the most ordinary one.
fn conditions(space: &Space, terms: &[Arc<dyn Term>]) -> Conditions {
    let matters = |need: Need| terms.iter().any(|t| t.info().needs.contains(&need));
    let Conditions { approaches, delta_t, waits } = &space.conditions;
    Conditions {
        approaches: ordinary(approaches, matters(Need::Approach), |a| -a.sign()),
        delta_t: ordinary(delta_t, matters(Need::DeltaT), f64::abs),
        waits: ordinary(waits, matters(Need::Elapsed), |t| t),
    }
}

/// All values where they matter, else the one of the least distance from the ordinary.
fn ordinary<T: Copy>(values: &[T], matters: bool, distance: fn(T) -> f64) -> Vec<T> {
    let nearest = values.iter().copied().reduce(|a, b| if distance(b) < distance(a) { b } else { a });
    if matters { values.to_vec() } else { nearest.into_iter().collect() }
}

/// The middle of the space and both ends of each coordinate.
fn ends(space: &Space) -> Vec<Pose> {
    let middle: [f64; 6] = std::array::from_fn(|k| f64::midpoint(space.low[k], space.high[k]));
    let end = |k: usize, x: f64| {
        let mut pose = middle;
        pose[k] = x;
        Pose::from_array(pose)
    };
    let both = space.free().into_iter().flat_map(|k| [end(k, space.high[k]), end(k, space.low[k])]);
    std::iter::once(Pose::from_array(middle)).chain(both).collect()
}

/// The nearest round numbers within the travel.
fn round(space: &Space, pose: &Pose) -> Pose {
    let x = pose.to_array();
    Pose::from_array(std::array::from_fn(|k| {
        let half = 0.5 * (space.high[k] - space.low[k]);
        if half > 0.0 { snapped(x[k], step(k, half)).clamp(space.low[k], space.high[k]) } else { x[k] }
    }))
}
