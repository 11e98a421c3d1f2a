//! A plan to start from: poses that tilt and shift a machine every way, under loads along and about its axes.

use hexbench_core::{Approach, Columns, Dataset, Hexapod, Measurand, Observation, Pose, Vector3, Wrench};
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
/// A smaller share is little: poses about the middle of the stroke tell more. The smallest that is tried.
const LITTLE: f64 = 0.25;
const LEAST: f64 = 0.02;
/// Steps that a half range must have at least; the finest ones, in a mm or a degree.
const FEWEST_STEPS: f64 = 3.0;
const FINEST: f64 = 1e3;
/// Halvings of the way to the middle of the stroke, which leave less than a nanometer.
const BISECTIONS: usize = 40;
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

/// The zero pose and eight others around it, in whole mm and half degrees, finer where there is little room, within the stroke if it is
/// stated. Where the zero pose is too near an end of the stroke, all nine are about a pose nearer its middle.
fn poses(hexapod: &Hexapod) -> Vec<Pose> {
    let range = usual_half_range_mm_deg(hexapod);
    let around = |middle_mm: f64, share: f64| {
        let corner = |signs| pose(signs, middle_mm, &range.map(|half| half * share));
        let middle = Pose::from_array([0.0, 0.0, middle_mm / 1e3, 0.0, 0.0, 0.0]);
        std::iter::once(middle).chain(CORNERS.map(corner)).collect::<Vec<Pose>>()
    };
    let shares = |least: f64| {
        std::iter::successors(Some(OUT), |share| Some(share * SHRINK)).take_while(move |share| *share > least)
    };
    let fits = |all: &Vec<Pose>| all.iter().all(|pose| is_within_stroke(hexapod, pose));
    let about_zero = shares(LITTLE).map(|share| around(0.0, share)).find(|all| fits(all));
    let about_middle = || {
        let middle = middle_of_stroke_mm(hexapod)?;
        shares(LEAST).map(|share| around(middle, share)).find(|all| fits(all))
    };
    about_zero.or_else(about_middle).unwrap_or_else(|| around(0.0, LEAST))
}

/// Height at which the legs are as long as the middle of their stroke in the mean, a multiple of 0.1 mm.
fn middle_of_stroke_mm(hexapod: &Hexapod) -> Option<f64> {
    let [shortest, longest] = hexapod.stroke?;
    let mean = |c: f64| {
        let pose = Pose::from_array([0.0, 0.0, c, 0.0, 0.0, 0.0]);
        leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, &pose).iter().sum::<f64>() / 6.0
    };
    let wanted = f64::midpoint(shortest, longest);
    let up = if mean(1e-4) > mean(0.0) { 1.0 } else { -1.0 };
    let toward = if mean(0.0) < wanted { up } else { -up };
    // Away from the base legs grow without end, toward it they shrink as far as its plane.
    let height = |joints: &[Vector3; 6]| joints.iter().map(|joint| joint.z).sum::<f64>() / 6.0;
    let above = (height(&hexapod.platform_joints) - height(&hexapod.base_joints)).abs();
    let (mut near, mut far) = (0.0, if toward * up > 0.0 { longest } else { above });
    for _ in 0..BISECTIONS {
        let between = f64::midpoint(near, far);
        let is_beyond = (mean(toward * between) < wanted) != (mean(0.0) < wanted);
        if is_beyond { far = between } else { near = between }
    }
    Some((toward * near * 1e4).round() / 10.0)
}

fn pose([a, b, c]: [f64; 3], middle_mm: f64, half: &[f64; 6]) -> Pose {
    let signs = [a, b, c, a * b, a * c, b * c];
    let set = |k: usize, coarsest: f64| {
        let mut steps = 1.0 / coarsest;
        while half[k] * steps < FEWEST_STEPS && steps < FINEST {
            steps *= 10.0;
        }
        (signs[k] * half[k] * steps).round() / steps
    };
    let [mm, degree] = [1.0, 0.5];
    let height = ((set(2, mm) + middle_mm) * 1e3).round() / 1e3;
    let angles = [3, 4, 5].map(|k| set(k, degree).to_radians());
    Pose::from_array([set(0, mm) / 1e3, set(1, mm) / 1e3, height / 1e3, angles[0], angles[1], angles[2]])
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
    #[test]
    fn a_machine_that_stands_at_the_end_of_its_stroke_is_measured_about_the_middle() {
        let rings = machine();
        let zero = leg_lengths(&rings.base_joints, &rings.platform_joints, &Pose::default());
        for (below, above) in [(0.05e-3, 30e-3), (30e-3, 0.05e-3), (2e-3, 0.4e-3)] {
            let stroke = Some([zero.min() - below, zero.max() + above]);
            let tight = Hexapod { stroke, ..machine() };
            let mut poses: Vec<[f64; 6]> =
                first_plan(&tight, 200.0).observations.iter().map(|o| o.pose.to_array()).collect();
            poses.dedup();
            assert!(poses.iter().all(|pose| is_within_stroke(&tight, &Pose::from_array(*pose))));
            assert_eq!(poses.len(), 9, "{below} {above}: {poses:?}");
            let steps = poses.iter().flat_map(|pose| [0, 1, 2].map(|k| pose[k] * 1e6));
            assert!(steps.into_iter().all(|um| (um - um.round()).abs() < 1e-6), "{poses:?}");
            let moves = |k: usize| poses.iter().any(|pose| (pose[k] - poses[0][k]).abs() > 0.0);
            assert!((0..6).all(moves), "{below} {above}: {poses:?}");
        }
    }
}
