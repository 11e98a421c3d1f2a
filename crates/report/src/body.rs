//! Joints of a machine under one condition, and how they move: what drawings in the plane and in space share.

use hexbench_core::{Vector3, Vector6};
use hexbench_model::estimation::campaign::Condition;

/// Base and platform end of every leg, fixed frame, m.
pub(crate) fn joints(at: &Condition) -> [[Vector3; 2]; 6] {
    std::array::from_fn(|leg| {
        let platform = at.place.translation + at.legs.arms[leg];
        [platform - at.legs.directions[leg] * at.legs.lengths[leg], platform]
    })
}

/// One end of every leg: 0 at the base, 1 at the platform.
pub(crate) fn ends(joints: &[[Vector3; 2]; 6], end: usize) -> [Vector3; 6] {
    joints.each_ref().map(|j| j[end])
}

/// Displacement of every platform joint by a twist, m.
pub(crate) fn displacements(at: &Condition, twist: &Vector6) -> [Vector3; 6] {
    let turn = Vector3::new(twist[3], twist[4], twist[5]);
    let shift = Vector3::new(twist[0], twist[1], twist[2]);
    at.legs.arms.map(|arm| shift + turn.cross(&arm))
}

/// Largest of some displacements, m.
pub(crate) fn largest(moves: &[Vector3; 6]) -> f64 {
    moves.iter().map(Vector3::norm).fold(0.0, f64::max)
}

/// Legs in the order of the angle of their joints about their mean: neighbors of a closed line through them.
pub(crate) fn around(joints: &[Vector3; 6]) -> [usize; 6] {
    let mean = joints.iter().sum::<Vector3>() / 6.0;
    let angle = |leg: usize| (joints[leg].y - mean.y).atan2(joints[leg].x - mean.x);
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|a, b| angle(*a).total_cmp(&angle(*b)));
    order
}
