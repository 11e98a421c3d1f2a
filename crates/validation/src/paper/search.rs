//! The best poses for identification: those with the largest observability index.
//!
//! Twelve numbers, as in the paper: a, b, c and gamma of three poses, level, under one vertical load. The paper's workspace
//! is not published; here a pose is allowed when no leg needs more stroke than the poses of the paper need.

use hexbench_core::{Hexapod, Measurand, Pose, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::kinematics::leg_lengths;
use hexbench_model::observability::Observability;
use hexbench_model::paper::block;
use nalgebra::DMatrix;
use slsqp::{StopTols, minimize};

use super::bench::{level_pose, loaded_pose};
use super::error::PaperError;

/// Numbers that describe one pose.
const PER_POSE: usize = 4;
/// Poses of a set.
const POSES: usize = 3;
const UNKNOWNS: usize = PER_POSE * POSES;
/// Largest a, b, c (mm) and gamma (deg) tried; the stroke is the tighter limit.
const BOX: [f64; PER_POSE] = [60.0, 60.0, 60.0, 40.0];

/// A set of poses and its index.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSet {
    /// a, b, c (mm) and gamma (deg) of each pose.
    pub poses: [[f64; PER_POSE]; POSES],
    /// Singular values and indices.
    pub observability: Observability,
}

impl PoseSet {
    /// The indices of given poses under a load, one reading each.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn of(hexapod: &Hexapod, poses: [[f64; PER_POSE]; POSES]) -> Result<Self, ModelError> {
        Ok(Self { poses, observability: observability(hexapod, &poses.map(level_pose), 1.0)? })
    }
}

/// Indices of `A` for poses under the paper's load times `share`, one reading each.
///
/// # Errors
/// [`ModelError::SingularPose`].
pub fn observability(hexapod: &Hexapod, poses: &[Pose], share: f64) -> Result<Observability, ModelError> {
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
pub fn best_poses(hexapod: &Hexapod, stroke: f64, starts: u32, seed: u32) -> Result<PoseSet, PaperError> {
    let ends = (0..starts).filter_map(|i| search(hexapod, stroke, start(i, seed)));
    let best = ends.max_by(|a, b| a.observability.o1.total_cmp(&b.observability.o1));
    best.ok_or(PaperError::NoPoses { starts, stroke_mm: stroke * 1e3 })
}

/// The `index`-th start, evenly spread over half the box.
fn start(index: u32, seed: u32) -> [f64; UNKNOWNS] {
    const SHARE: f64 = 0.5;
    std::array::from_fn(|k| {
        let dimension = u32::try_from(k).unwrap_or(0);
        SHARE * (2.0 * f64::from(sobol_burley::sample(index, dimension, seed)) - 1.0)
    })
}

fn search(hexapod: &Hexapod, stroke: f64, start: [f64; UNKNOWNS]) -> Option<PoseSet> {
    const MOST: usize = 200;
    const SLACK: f64 = 1e-6;
    let objective = |x: &[f64]| {
        let poses = unpack(x).map(level_pose);
        // A singular pose has no index; it is as bad as one that sees nothing.
        observability(hexapod, &poses, 1.0).map_or(0.0, |o| -o.o1.max(f64::MIN_POSITIVE).ln())
    };
    let within = |x: &[f64], k: usize| {
        let pose = level_pose(unpack(x)[k / 6]);
        (extension(hexapod, &pose)[k % 6] / stroke).powi(2) - 1.0
    };
    let with_gradient = |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| value(&objective, x, gradient);
    let constraint = |k: usize| {
        move |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
            value(&|x: &[f64]| within(x, k), x, gradient)
        }
    };
    let constraints: Vec<_> = (0..6 * POSES).map(constraint).collect();
    let constraints: Vec<&dyn slsqp::Func<()>> = constraints.iter().map(|c| c as _).collect();
    let tolerances = StopTols { ftol_rel: 1e-9, ..StopTols::default() };
    let bounds = [(-1.0, 1.0); UNKNOWNS];
    let end = minimize(with_gradient, &start, &bounds, &constraints, (), MOST, Some(tolerances));
    let x = match end {
        Ok((_, x, _)) | Err((_, x, _)) => x,
    };
    let allowed = (0..6 * POSES).all(|k| within(&x, k) <= SLACK);
    PoseSet::of(hexapod, unpack(&x)).ok().filter(|_| allowed)
}

/// A function and its central differences.
fn value(f: &dyn Fn(&[f64]) -> f64, x: &[f64], gradient: Option<&mut [f64]>) -> f64 {
    const STEP: f64 = 1e-6;
    if let Some(gradient) = gradient {
        let mut at = x.to_vec();
        for k in 0..x.len() {
            at[k] = x[k] + STEP;
            let above = f(&at);
            at[k] = x[k] - STEP;
            gradient[k] = (above - f(&at)) / (2.0 * STEP);
            at[k] = x[k];
        }
    }
    f(x)
}

fn unpack(x: &[f64]) -> [[f64; PER_POSE]; POSES] {
    std::array::from_fn(|i| std::array::from_fn(|k| x[PER_POSE * i + k] * BOX[k]))
}
