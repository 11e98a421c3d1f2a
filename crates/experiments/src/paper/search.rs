//! The best poses for identification: those with the largest observability index.
//!
//! Twelve numbers, as in the paper: a, b, c and gamma of three poses, level, under one vertical load. The paper's workspace
//! is not published; here a pose is allowed when no leg needs more stroke than the poses of the paper need.

use hexbench_core::{Hexapod, Measurand, Pose, Vector6};
use hexbench_design::regressor::{SpringRegressor, Weights};
use hexbench_design::space::{Conditions, Loading};
use hexbench_design::{Budget, Criterion, Objective, PoseProblem, Space};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::paper::block;
use hexbench_model::machine::kinematics::leg_lengths;
use hexbench_model::machine::observability::Observability;
use hexbench_truth::Situation;
use nalgebra::DMatrix;

use super::bench::{level_pose, loaded_pose};
use super::error::PaperError;

/// Numbers that describe one pose.
const PER_POSE: usize = 4;
/// Poses of a set.
const POSES: usize = 3;
/// Largest a, b, c (mm) and gamma (deg) tried; the stroke is the tighter limit.
const BOX: [f64; PER_POSE] = [60.0, 60.0, 60.0, 40.0];

/// A set of poses and its index.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexedPoses {
    /// a, b, c (mm) and gamma (deg) of each pose.
    pub poses: [[f64; PER_POSE]; POSES],
    /// Singular values and indices.
    pub observability: Observability,
}

impl IndexedPoses {
    /// The indices of given poses under a load, one reading each.
    pub(crate) fn of(hexapod: &Hexapod, poses: [[f64; PER_POSE]; POSES]) -> Result<Self, ModelError> {
        Ok(Self { poses, observability: observability(hexapod, &poses.map(level_pose), 1.0)? })
    }
}

/// Indices of `A` for poses under the paper's load times `share`, one reading each.
pub(crate) fn observability(
    hexapod: &Hexapod,
    poses: &[Pose],
    share: f64,
) -> Result<Observability, ModelError> {
    let mut a = DMatrix::zeros(6 * poses.len(), 6);
    for (i, pose) in poses.iter().enumerate() {
        let reading = super::bench::unread(loaded_pose(*pose));
        let block = block(hexapod, &reading, Measurand::DeflectionEuler)?;
        a.fixed_view_mut::<6, 6>(6 * i, 0).copy_from(&(block * share));
    }
    Ok(Observability::new(a.singular_values().iter().copied(), poses.len()))
}

/// Largest change of a leg length from the zero pose over poses, m.
pub fn stroke(hexapod: &Hexapod, poses: &[Pose]) -> f64 {
    poses.iter().map(|p| extension(hexapod, p).amax()).fold(0.0, f64::max)
}

fn extension(hexapod: &Hexapod, pose: &Pose) -> Vector6 {
    let lengths = |p: &Pose| leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, p);
    lengths(pose) - lengths(&Pose::default())
}

/// The best of many searches, each from its own start, with legs that stay within `stroke` (m) of the zero pose.
///
/// # Errors
/// [`PaperError::NoPoses`] when no search ends at an allowed set.
pub fn best_poses(
    hexapod: &Hexapod,
    stroke: f64,
    starts: u32,
    seed: u32,
) -> Result<IndexedPoses, PaperError> {
    let space = space(hexapod, stroke);
    let problem = PoseProblem {
        hexapod,
        space: &space,
        regressor: &SpringRegressor::new(hexapod, &space.settings(), 1, Weights::UNWEIGHTED),
        criterion: &Objective::from(Criterion::O1),
        poses: POSES,
        known: None,
    };
    let none = |_| PaperError::NoPoses { starts, stroke_mm: stroke * 1e3 };
    let found = problem.search(starts as usize, seed, &|| ()).map_err(none)?;
    Ok(IndexedPoses::of(hexapod, std::array::from_fn(|k| level_coordinates(&found.best.poses[k])))?)
}

/// Level poses whose legs change their length by `stroke` (m) at most, under the paper's load.
fn space(hexapod: &Hexapod, stroke: f64) -> Space {
    let Situation { reference, wrench: load, .. } = loaded_pose(Pose::default());
    // The six legs of the paper's machine are equally long at the zero pose.
    let home = leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, &Pose::default()).mean();
    let [a, b, c, gamma] = BOX;
    let reach = level_pose([a, b, c, gamma]).to_array();
    Space {
        low: reach.map(|x| -x),
        high: reach,
        stroke: Some([home - stroke, home + stroke]),
        joint_angle: None,
        least_dexterity: 0.0,
        loads: vec![Loading { reference, load }],
        load_ranges: Vec::new(),
        conditions: Conditions::default(),
        budget: Budget::default(),
    }
}

/// a, b, c in mm, gamma in deg.
fn level_coordinates(pose: &Pose) -> [f64; PER_POSE] {
    let t = pose.translation * 1e3;
    [t.x, t.y, t.z, pose.angles.z.to_degrees()]
}
