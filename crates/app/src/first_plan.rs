//! A plan to start from: poses that tilt and shift a machine every way, under loads along and about its axes.

use hexbench_core::{Approach, Columns, Dataset, Hexapod, Measurand, Observation, Pose, Wrench};
use hexbench_model::machine::kinematics::leg_lengths;
use hexbench_truth::campaign::usual_half_range_mm_deg;

/// Signs of a, b, c in eight poses; those of the angles are products of two, so that no two coordinates go together.
const CORNERS: [[f64; 3]; 8] = [
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, -1.0, 1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, -1.0, -1.0],
];
/// Share of the usual range, and by how much it shrinks until the stroke allows every pose.
const OUT: f64 = 0.6;
const SHRINK: f64 = 0.9;
/// Of the largest force: what hangs in the reference state, pulls up, pulls sideways.
const REFERENCE: f64 = 0.3;
const LIFT: f64 = 0.5;
const SIDEWAYS: f64 = 0.6;
/// Arm of a moment by that force, in radii of the platform.
const ARM: f64 = 0.4;

/// Readings to be taken of a machine with forces up to so many N: the zero pose and eight around it, each under one vertical load, read
/// twice and once more coming back from an overload, and under four loads along and about other axes.
pub fn first_plan(hexapod: &Hexapod, force: f64) -> Dataset {
    let poses = poses(hexapod);
    let columns = Columns { reference: true, approach: true, ..Columns::default() };
    let rows = (1..).zip(poses).flat_map(|(pose_id, pose)| at(hexapod, force, pose_id, pose));
    Dataset::of_poses("plan.csv", Measurand::DeflectionEuler, columns, rows.collect())
}

fn at(hexapod: &Hexapod, force: f64, pose_id: i64, pose: Pose) -> Vec<Observation> {
    let rest = -REFERENCE * force;
    let moment = ARM * hexapod.platform_radius() * force;
    let load = |wrench: [f64; 6]| Wrench::from_array(wrench.map(to_tenth));
    let reference = load([0.0, 0.0, rest, 0.0, 0.0, 0.0]);
    let full = load([0.0, 0.0, -force, 0.0, 0.0, 0.0]);
    let others = [
        [0.0, 0.0, LIFT * force, 0.0, 0.0, 0.0],
        [SIDEWAYS * force, 0.0, rest, 0.0, 0.0, 0.0],
        [0.0, SIDEWAYS * force, rest, 0.0, 0.0, 0.0],
        [0.0, 0.0, rest, moment, 0.0, 0.0],
    ];
    let row = |wrench, repeat, approach| Observation {
        pose_id,
        repeat,
        approach,
        ..Observation::unread(pose, wrench, reference)
    };
    let first =
        [row(full, 1, Approach::Direct), row(full, 2, Approach::Direct), row(full, 1, Approach::Overloaded)];
    first.into_iter().chain(others.map(|wrench| row(load(wrench), 1, Approach::Direct))).collect()
}

fn to_tenth(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}

/// The zero pose and eight others, in whole mm and half degrees, within the stroke if it is stated.
fn poses(hexapod: &Hexapod) -> Vec<Pose> {
    let range = usual_half_range_mm_deg(hexapod);
    let mut share = OUT;
    loop {
        let around = CORNERS.map(|corner| pose(corner, &range.map(|half| half * share)));
        let all: Vec<Pose> = std::iter::once(Pose::default()).chain(around).collect();
        if share < 0.05 || all.iter().skip(1).all(|pose| is_within_stroke(hexapod, pose)) {
            return all;
        }
        share *= SHRINK;
    }
}

fn pose([a, b, c]: [f64; 3], half: &[f64; 6]) -> Pose {
    let signs = [a, b, c, a * b, a * c, b * c];
    let mm = |k: usize| (signs[k] * half[k]).round() / 1e3;
    let angle = |k: usize| ((signs[k] * half[k] * 2.0).round() / 2.0).to_radians();
    Pose::from_array([mm(0), mm(1), mm(2), angle(3), angle(4), angle(5)])
}

fn is_within_stroke(hexapod: &Hexapod, pose: &Pose) -> bool {
    let Some([shortest, longest]) = hexapod.stroke else { return true };
    let lengths = leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, pose);
    lengths.iter().all(|length| (shortest..=longest).contains(length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexbench_core::JointCircle;

    fn machine() -> Hexapod {
        let base = JointCircle::base_pairs(0.16, 0.35).joints(-0.165);
        Hexapod::of_joints("rings", base, JointCircle::platform_pairs(0.12, 0.5).joints(0.0))
    }

    #[test]
    fn coordinates_of_the_poses_do_not_go_together() {
        let plan = first_plan(&machine(), 200.0);
        let mut poses: Vec<[f64; 6]> = plan.observations.iter().map(|o| o.pose.to_array()).collect();
        poses.dedup();
        assert_eq!(poses.len(), 9);
        for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let product: f64 = poses.iter().map(|pose| pose[i] * pose[j]).sum();
            assert!(product.abs() < 1e-15, "{i} and {j}: {product}");
        }
    }

    #[test]
    fn a_narrow_stroke_draws_the_poses_together() {
        let stroke = Some([0.185, 0.205]);
        let narrow = Hexapod { stroke, ..machine() };
        let farthest = |h: &Hexapod| {
            first_plan(h, 200.0).observations.iter().map(|o| o.pose.translation.norm()).fold(0.0, f64::max)
        };
        assert!(farthest(&narrow) < 0.6 * farthest(&machine()));
        let plan = first_plan(&narrow, 200.0);
        assert!(plan.observations.iter().all(|o| is_within_stroke(&narrow, &o.pose)));
    }
}
