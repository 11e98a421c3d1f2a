//! Leg kinematics: lengths, directions and Jacobians of a pose.

use hexbench_core::{Matrix3, Matrix6, Vector3, Vector6};

use crate::error::ModelError;
use crate::machine::placement::Placement;

/// Condition number of the scaled leg Jacobian beyond which a pose counts as singular.
const SINGULAR_CONDITION: f64 = 1e8;

/// Legs at one pose. Fixed frame, SI.
#[derive(Debug, Clone, Copy)]
pub struct Legs {
    /// `q_i`: leg lengths, m.
    pub lengths: Vector6,
    /// `n_i`: unit vectors from base joint to platform joint, fixed axes.
    pub directions: [Vector3; 6],
    /// `R B_i`: platform joints seen from the mobile origin, fixed axes, m.
    pub arms: [Vector3; 6],
    /// Geometric leg Jacobian L (6x6): leg rates = L `[v; omega]`, row `[n_i', (R B_i x n_i)']`.
    pub leg_jacobian: Matrix6,
    /// Geometric platform Jacobian: inverse of the leg Jacobian, twist per leg elongation.
    pub platform_jacobian: Matrix6,
}

/// Joints nearer in height than this lie in one plane, m.
const ONE_PLANE: f64 = 1e-6;

impl Legs {
    /// Legs of a machine with base joints `A_i` (fixed frame) and platform joints `B_i` (mobile frame) at a pose.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`] when leg rates do not determine the twist, or a leg has no length.
    pub fn at(
        base: &[Vector3; 6],
        platform: &[Vector3; 6],
        place: impl Into<Placement>,
    ) -> Result<Self, ModelError> {
        let place = place.into();
        let arms = platform.map(|b| place.rotation * b);
        let spans: [Vector3; 6] = std::array::from_fn(|i| place.translation + arms[i] - base[i]);
        let lengths = Vector6::from_fn(|i, _| spans[i].norm());
        let directions = std::array::from_fn(|i| spans[i] / lengths[i]);
        let leg_jacobian = leg_jacobian(&directions, &arms);
        let platform_jacobian = inverse(&leg_jacobian).ok_or_else(|| ModelError::SingularPose {
            pose: place.pose(),
            has_no_height: spans.iter().all(|span| span.z.abs() < ONE_PLANE),
        })?;
        Ok(Self { lengths, directions, arms, leg_jacobian, platform_jacobian })
    }

    /// Bound of the turn of the legs under a small geometric twist `[v; w]` of the platform, rad: `max |v + w x a_i| / l_i`.
    pub fn turn(&self, twist: &Vector6) -> f64 {
        let (shift, rotation) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
        let of_leg = |(arm, length): (&Vector3, &f64)| (shift + rotation.cross(arm)).norm() / length;
        self.arms.iter().zip(self.lengths.iter()).map(of_leg).fold(0.0, f64::max)
    }

    /// Leg forces (N, tension positive) that balance a wrench `[F; M]` at the mobile origin: `f = L^-T W`.
    pub fn forces(&self, wrench: &Vector6) -> Vector6 {
        self.platform_jacobian.tr_mul(wrench)
    }
}

/// Leg forces (N) and vectors from base joint to platform joint (m) at a pose a small deflection away from known legs: one step of refinement on `L' f = W`, whose error is
/// of second order in the change of the Jacobian.
pub fn forces_near(
    known: &Legs,
    base: &[Vector3; 6],
    platform: &[Vector3; 6],
    place: &Placement,
    wrench: &Vector6,
) -> (Vector6, [Vector3; 6]) {
    let first = known.forces(wrench);
    let mut unbalanced = *wrench;
    let spans = std::array::from_fn(|leg| {
        let arm = place.rotation * platform[leg];
        let span = place.translation + arm - base[leg];
        let direction = span.normalize();
        let (pull, moment) = (direction * first[leg], arm.cross(&direction) * first[leg]);
        unbalanced -= Vector6::new(pull.x, pull.y, pull.z, moment.x, moment.y, moment.z);
        span
    });
    (first + known.forces(&unbalanced), spans)
}

/// Leg lengths only, m: `q_i = |t + R B_i - A_i|`.
pub fn leg_lengths(base: &[Vector3; 6], platform: &[Vector3; 6], place: impl Into<Placement>) -> Vector6 {
    let place = place.into();
    Vector6::from_fn(|i, _| (place.translation + place.rotation * platform[i] - base[i]).norm())
}

fn leg_jacobian(directions: &[Vector3; 6], arms: &[Vector3; 6]) -> Matrix6 {
    Matrix6::from_fn(|i, j| if j < 3 { directions[i][j] } else { arms[i].cross(&directions[i])[j - 3] })
}

/// Inverse with the moment columns scaled to the size of the force columns, so that the test for singularity
/// does not depend on the unit of length.
fn inverse(l: &Matrix6) -> Option<Matrix6> {
    if !l.iter().all(|x| x.is_finite()) {
        return None;
    }
    let moment = l.fixed_columns::<3>(3).norm();
    if moment <= 0.0 {
        return None;
    }
    let scale = l.fixed_columns::<3>(0).norm() / moment;
    let mut scaled = *l;
    scaled.fixed_columns_mut::<3>(3).scale_mut(scale);
    let mut inverse = inverse_of_six(&scaled)?;
    let condition = scaled.norm() * inverse.norm();
    if !condition.is_finite() || condition > SINGULAR_CONDITION {
        return None;
    }
    inverse.fixed_rows_mut::<3>(3).scale_mut(scale);
    Some(inverse)
}

/// Inverse by Gauss-Jordan elimination with partial pivoting, in place: a column that is eliminated makes room for one of the inverse.
fn inverse_of_six(matrix: &Matrix6) -> Option<Matrix6> {
    let mut rows: [[f64; 6]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]));
    let mut order: [usize; 6] = std::array::from_fn(|i| i);
    eliminate::<0>(&mut rows, &mut order)?;
    eliminate::<1>(&mut rows, &mut order)?;
    eliminate::<2>(&mut rows, &mut order)?;
    eliminate::<3>(&mut rows, &mut order)?;
    eliminate::<4>(&mut rows, &mut order)?;
    eliminate::<5>(&mut rows, &mut order)?;
    // Rows that changed places are columns of the inverse that did.
    let mut inverse = Matrix6::zeros();
    for (j, &column) in order.iter().enumerate() {
        for (i, row) in rows.iter().enumerate() {
            inverse[(i, column)] = row[j];
        }
    }
    Some(inverse)
}

/// One column of it; its number is known as this is compiled, so that no choice among columns is left to the loops. Rows are made anew as a
/// whole: a single number written into one would have the next load of it wait.
#[inline]
fn eliminate<const K: usize>(rows: &mut [[f64; 6]; 6], order: &mut [usize; 6]) -> Option<()> {
    let mut pivot = K;
    for i in K + 1..6 {
        if rows[i][K].abs() >= rows[pivot][K].abs() {
            pivot = i;
        }
    }
    rows.swap(K, pivot);
    order.swap(K, pivot);
    let scale = rows[K][K].recip();
    if !scale.is_finite() {
        return None;
    }
    let own: [f64; 6] = std::array::from_fn(|j| if j == K { scale } else { rows[K][j] * scale });
    for (i, row) in rows.iter_mut().enumerate() {
        let (share, before) = (row[K], |j: usize| if j == K { 0.0 } else { row[j] });
        *row = if i == K { own } else { std::array::from_fn(|j| before(j) - share * own[j]) };
    }
    Some(())
}

/// `M` (3x3) with `omega = M [alpha', beta', gamma']`: fixed-axes angular velocity from Euler rates
/// (extrinsic X-Y-Z). Source: Kalas et al. 2018, eq. 6.
pub fn euler_rate_matrix(angles: &Vector3) -> Matrix3 {
    let (sb, cb) = angles.y.sin_cos();
    let (sg, cg) = angles.z.sin_cos();
    Matrix3::new(cg * cb, -sg, 0.0, sg * cb, cg, 0.0, -sb, 0.0, 1.0)
}

/// Analytic leg Jacobian: leg rates from `[a', b', c', alpha', beta', gamma']`, `L diag(I, M)`.
/// Source: Kalas et al. 2018, eq. 5.
pub fn analytic_leg_jacobian(legs: &Legs, angles: &Vector3) -> Matrix6 {
    let mut jacobian = legs.leg_jacobian;
    let moment = jacobian.fixed_columns::<3>(3) * euler_rate_matrix(angles);
    jacobian.fixed_columns_mut::<3>(3).copy_from(&moment);
    jacobian
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_times_its_inverse_is_the_identity_whatever_its_pivots() {
        let entry = |i: usize, j: usize| ((1 + i * j * j + 3 * i * i * (j + 1) + 5 * j) as f64).sin();
        let mut matrix = Matrix6::from_fn(entry);
        matrix[(0, 0)] = 0.0;
        let off = (matrix * inverse_of_six(&matrix).unwrap() - Matrix6::identity()).amax();
        assert!(off < 1e-12, "{off:.1e}");
        let row = matrix.row(1).into_owned();
        matrix.set_row(4, &row);
        assert!(inverse_of_six(&matrix).is_none_or(|inverse| inverse.amax() > 1e12));
    }
}
