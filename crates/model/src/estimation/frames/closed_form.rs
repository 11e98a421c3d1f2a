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
use nalgebra::{Cholesky, Const, Isometry3, Rotation3, SVD, Translation3, UnitQuaternion};

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
            angle_between(&p.measured, &reference.measured)
                - angle_between(&p.commanded, &reference.commanded)
        };
        pairs.iter().map(|p| angle(p).abs()).collect()
    };
    let stride = pairs.len().div_ceil(REFERENCES).max(1);
    let tried = pairs.iter().step_by(stride).map(unlike);
    let typical = |off: &Vec<f64>| median(off.iter().copied()).unwrap_or(0.0);
    let best = tried.min_by(|a, b| typical(a).total_cmp(&typical(b)));
    best.map_or_else(Vec::new, |off| chosen(pairs, &off, ALIKE))
}

/// Angle between two rotations, rad, to 1e-8.
fn angle_between(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    2.0 * a.rotation.coords.dot(&b.rotation.coords).abs().min(1.0).acos()
}

fn chosen(pairs: &[Pair], off: &[f64], least: f64) -> Vec<Pair> {
    let limit = FAR * median(off.iter().copied()).unwrap_or(0.0) + least;
    pairs.iter().zip(off).filter(|(_, off)| **off <= limit).map(|(p, _)| *p).collect()
}

/// Rotations of one pair.
struct Turn {
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
        from: logarithm(&(x * from.transpose())),
        to: logarithm(&(y * to.transpose())),
    };
    let turns: Vec<Turn> = commanded.iter().zip(&measured).map(turn).collect();
    let silent = SILENT * SILENT * pairs.len() as f64;
    let by_turns =
        turns.iter().map(|t| t.to * t.from.transpose()).sum::<Matrix3>() + to * from.transpose() * silent;
    let places = Places::of(pairs, &commanded);
    let by_places = |target: &Vector3| places.correlation(target) / (lever * lever);
    let first = if are_telling(&turns) { by_turns } else { by_turns + by_places(&Vector3::zeros()) };
    let mut axes = nearest_rotation(&first);
    let mut shifts = places.shifts(&axes);
    for _ in 0..ROUNDS {
        axes = nearest_rotation(&(by_turns + by_places(&shifts.target)));
        shifts = places.shifts(&axes);
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

/// Sums over pairs, about their means, from which places and axes follow without looking at a pair again.
struct Places {
    /// Mean place that was commanded, mean rotation, mean place that was measured.
    means: (Vector3, Matrix3, Vector3),
    /// Measured by commanded places, m^2.
    together: Matrix3,
    /// Measured places by each column of the commanded rotations, m.
    by_column: [Matrix3; 3],
    /// Commanded rotations by commanded places, m.
    by_turn: Vector3,
    /// Normal equations of the place of the target.
    normal: Option<Cholesky<f64, Const<3>>>,
}

impl Places {
    fn of(pairs: &[Pair], commanded: &[Matrix3]) -> Self {
        let n = pairs.len().max(1) as f64;
        let from_mean = pairs.iter().map(|p| place(&p.commanded)).sum::<Vector3>() / n;
        let to_mean = pairs.iter().map(|p| place(&p.measured)).sum::<Vector3>() / n;
        let turn_mean = commanded.iter().sum::<Matrix3>() / n;
        let (mut together, mut by_column) = (Matrix3::zeros(), [Matrix3::zeros(); 3]);
        let (mut by_turn, mut normal) = (Vector3::zeros(), Matrix3::identity() * (SILENT * SILENT * n));
        for (pair, turn) in pairs.iter().zip(commanded) {
            let (from, to) = (place(&pair.commanded) - from_mean, place(&pair.measured) - to_mean);
            let turn = turn - turn_mean;
            together += to * from.transpose();
            by_column.iter_mut().zip(turn.column_iter()).for_each(|(sum, c)| *sum += to * c.transpose());
            by_turn += turn.tr_mul(&from);
            normal += turn.tr_mul(&turn);
        }
        let means = (from_mean, turn_mean, to_mean);
        Self { means, together, by_column, by_turn, normal: normal.cholesky() }
    }

    /// Correlation of measured and commanded places of the target, m^2.
    fn correlation(&self, target: &Vector3) -> Matrix3 {
        self.together + self.by_column.iter().zip(target).map(|(sum, t)| sum * *t).sum::<Matrix3>()
    }

    /// Least squares for both translations when the axes `R_M` are known; a target that no tilt shows stays at the mobile origin.
    fn shifts(&self, axes: &Matrix3) -> Shifts {
        let (from, turn, to) = self.means;
        let right = Vector3::from(self.by_column.map(|sum| axes.dot(&sum))) - self.by_turn;
        let target = self.normal.as_ref().map_or_else(Vector3::zeros, |c| c.solve(&right));
        Shifts { metrology: to - axes * (from + turn * target), target }
    }
}

struct Shifts {
    metrology: Vector3,
    target: Vector3,
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
