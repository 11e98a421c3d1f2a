//! Two frames from pairs of poses, `Y_i = M X_i T` (robot-world and hand-eye calibration at once), in closed form.
//!
//! Rotations first: about the mean rotations, the rotation vectors of measured and commanded poses are turned into each other by
//! `R_M` alone, whatever the target is: `log(R_Yi Y'^T) = R_M log(R_Xi X'^T)`; then `R_T = X'^T R_M^T Y'`. The translations
//! follow from linear least squares, `R_M^T p_Yi = p_Xi + R_Xi t_T + R_M^T t_M`. Positions then help to turn `R_M`.
//! What the poses leave open is settled by the target nearest to the mobile frame: a very small weight does it.
//!
//! Source: Park and Martin (1994), "Robot sensor calibration: solving AX = XB on the Euclidean group"; the mean rotation and the
//! best rotation between vectors after Kabsch (1976) and Umeyama (1991).

use hexbench_core::statistics::median;
use hexbench_core::{Matrix3, Vector3};
use nalgebra::{Isometry3, Rotation3, SVD, Translation3, UnitQuaternion};

use super::{Frames, Pair};

/// A tilt (rad) so small that it says nothing about where axes and targets are: weight of the target nearest to the platform.
const SILENT: f64 = 1e-4;
/// Tilts about two axes beyond this (rad) tell the axes by themselves; below, positions help from the start.
const TELLING: f64 = 5e-3;
/// Times that positions and rotations are turned into each other together.
const ROUNDS: usize = 20;
/// Times that rows far from the rest are chosen anew.
const TRIALS: usize = 5;
/// A row this many times farther off than the median is left out of the start.
const FAR: f64 = 3.0;
/// Angles between rows that differ less (rad) are alike: a machine turns this well.
const ALIKE: f64 = 1e-3;
/// Rows tried as the one from which angles are measured.
const REFERENCES: usize = 11;
/// Rounding of leg lengths, as a share of one.
const ROUNDING: f64 = 1e-12;
/// Iterations of a singular value decomposition before giving up; three by three needs a handful.
const MOST_ITERATIONS: usize = 200;

/// Frames that carry most commanded poses to the measured ones; `lever` in m makes an angle a length.
pub(super) fn aligned(pairs: &[Pair], lever: f64) -> Frames {
    let mut kept = turned_alike(pairs);
    let mut found = solved(&kept, lever);
    for _ in 0..TRIALS {
        let next = near(pairs, &found, lever);
        if next == kept {
            break;
        }
        found = solved(&next, lever);
        kept = next;
    }
    found
}

/// Rows not far from what frames say.
fn near(pairs: &[Pair], frames: &Frames, lever: f64) -> Vec<Pair> {
    let off: Vec<f64> = pairs
        .iter()
        .map(|p| frames.departure_of(p))
        .map(|d| d.translation.hypot(lever * d.rotation))
        .collect();
    chosen(pairs, &off, lever * ROUNDING)
}

/// Rows between which the instrument saw the angles that were commanded: those do not depend on any frame, so a blundered row
/// shows before anything is solved.
fn turned_alike(pairs: &[Pair]) -> Vec<Pair> {
    let unlike = |reference: &Pair| -> Vec<f64> {
        let angle = |p: &Pair| {
            p.measured.rotation.angle_to(&reference.measured.rotation)
                - p.commanded.rotation.angle_to(&reference.commanded.rotation)
        };
        pairs.iter().map(|p| angle(p).abs()).collect()
    };
    let stride = pairs.len().div_ceil(REFERENCES).max(1);
    let tried = pairs.iter().step_by(stride).map(unlike);
    let typical = |off: &Vec<f64>| median(off.iter().copied()).unwrap_or(0.0);
    let best = tried.min_by(|a, b| typical(a).total_cmp(&typical(b)));
    best.map_or_else(Vec::new, |off| chosen(pairs, &off, ALIKE))
}

fn chosen(pairs: &[Pair], off: &[f64], least: f64) -> Vec<Pair> {
    let limit = FAR * median(off.iter().copied()).unwrap_or(0.0) + least;
    pairs.iter().zip(off).filter(|(_, off)| **off <= limit).map(|(p, _)| *p).collect()
}

/// Rotations of one pair.
struct Turn {
    commanded: Matrix3,
    /// `log(R_X X'^T)`.
    from: Vector3,
    /// `log(R_Y Y'^T)`.
    to: Vector3,
}

/// Frames of pairs without blunders.
fn solved(pairs: &[Pair], lever: f64) -> Frames {
    let commanded: Vec<Matrix3> = pairs.iter().map(|p| matrix(&p.commanded)).collect();
    let measured: Vec<Matrix3> = pairs.iter().map(|p| matrix(&p.measured)).collect();
    let (from, to) = (nearest_rotation(&commanded.iter().sum()), nearest_rotation(&measured.iter().sum()));
    let turn = |(x, y): (&Matrix3, &Matrix3)| Turn {
        commanded: *x,
        from: logarithm(&(x * from.transpose())),
        to: logarithm(&(y * to.transpose())),
    };
    let turns: Vec<Turn> = commanded.iter().zip(&measured).map(turn).collect();
    let silent = SILENT * SILENT * pairs.len() as f64;
    let by_turns =
        turns.iter().map(|t| t.to * t.from.transpose()).sum::<Matrix3>() + to * from.transpose() * silent;
    let by_places = |target: &Vector3| places(pairs, &turns, target) / (lever * lever);
    let first = if are_telling(&turns) { by_turns } else { by_turns + by_places(&Vector3::zeros()) };
    let mut axes = nearest_rotation(&first);
    let mut shifts = translations(pairs, &turns, &axes);
    for _ in 0..ROUNDS {
        axes = nearest_rotation(&(by_turns + by_places(&shifts.target)));
        shifts = translations(pairs, &turns, &axes);
    }
    let target = from.transpose() * axes.transpose() * to;
    Frames { metrology: rigid(&axes, shifts.metrology), target: rigid(&target, shifts.target) }
}

/// True when poses tilt about two axes and more.
fn are_telling(turns: &[Turn]) -> bool {
    let spread: Matrix3 = turns.iter().map(|t| t.from * t.from.transpose()).sum();
    let mut sizes: [f64; 3] = spread.symmetric_eigenvalues().into();
    sizes.sort_by(f64::total_cmp);
    sizes[1] > TELLING * TELLING * turns.len() as f64
}

/// Correlation of measured and commanded places of the target, each about its mean, m^2.
fn places(pairs: &[Pair], turns: &[Turn], target: &Vector3) -> Matrix3 {
    let from: Vec<Vector3> =
        pairs.iter().zip(turns).map(|(p, t)| place(&p.commanded) + t.commanded * target).collect();
    let to: Vec<Vector3> = pairs.iter().map(|p| place(&p.measured)).collect();
    let (from_mean, to_mean) = (mean(&from), mean(&to));
    from.iter().zip(&to).map(|(a, b)| (b - to_mean) * (a - from_mean).transpose()).sum()
}

struct Shifts {
    metrology: Vector3,
    target: Vector3,
}

/// Least squares for both translations when the axes `R_M` are known; a target that no tilt shows stays at the mobile origin.
fn translations(pairs: &[Pair], turns: &[Turn], axes: &Matrix3) -> Shifts {
    let n = pairs.len().max(1) as f64;
    let off: Vec<Vector3> =
        pairs.iter().map(|p| axes.tr_mul(&place(&p.measured)) - place(&p.commanded)).collect();
    let off_mean = mean(&off);
    let turn_mean = turns.iter().map(|t| t.commanded).sum::<Matrix3>() / n;
    let mut normal = Matrix3::identity() * (SILENT * SILENT * n);
    let mut right = Vector3::zeros();
    for (turn, off) in turns.iter().zip(&off) {
        let column = turn.commanded - turn_mean;
        normal += column.transpose() * column;
        right += column.transpose() * (off - off_mean);
    }
    let target = normal.cholesky().map_or_else(Vector3::zeros, |c| c.solve(&right));
    Shifts { metrology: axes * (off_mean - turn_mean * target), target }
}

/// The rotation nearest to a matrix; the identity where none is.
fn nearest_rotation(m: &Matrix3) -> Matrix3 {
    let svd = SVD::try_new(*m, true, true, f64::EPSILON, MOST_ITERATIONS);
    let Some((u, v_t, sizes)) = svd.and_then(|s| Some((s.u?, s.v_t?, s.singular_values))) else {
        return Matrix3::identity();
    };
    let mut sides = Vector3::repeat(1.0);
    sides[sizes.imin()] = (u * v_t).determinant().signum();
    u * Matrix3::from_diagonal(&sides) * v_t
}

fn logarithm(r: &Matrix3) -> Vector3 {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*r)).scaled_axis()
}

fn matrix(frame: &Isometry3<f64>) -> Matrix3 {
    *frame.rotation.to_rotation_matrix().matrix()
}

fn place(frame: &Isometry3<f64>) -> Vector3 {
    frame.translation.vector
}

fn rigid(axes: &Matrix3, translation: Vector3) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*axes));
    Isometry3::from_parts(Translation3::from(translation), rotation)
}

fn mean(all: &[Vector3]) -> Vector3 {
    all.iter().sum::<Vector3>() / all.len().max(1) as f64
}
