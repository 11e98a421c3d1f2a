//! Rotations by their rotation vector.

use hexbench_core::{Matrix3, Vector3};

/// Below this angle (rad) the series of sine and cosine replace the quotients; its fourth power is under one rounding.
const SMALL_ANGLE: f64 = 1e-4;

/// `[w]x`, the matrix of `w x .`.
pub fn skew(w: &Vector3) -> Matrix3 {
    Matrix3::new(0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0)
}

/// Rotation by the vector `w` (rad, fixed axes): `exp([w]x)`.
pub fn exp(w: &Vector3) -> Matrix3 {
    let angle = w.norm();
    let (a, b) = if angle < SMALL_ANGLE {
        (1.0 - angle * angle / 6.0, 0.5 - angle * angle / 24.0)
    } else {
        (angle.sin() / angle, (1.0 - angle.cos()) / (angle * angle))
    };
    let k = skew(w);
    Matrix3::identity() + k * a + k * k * b
}

/// Rotation vector (rad) of a rotation matrix, for angles well below 180 deg.
pub fn log(r: &Matrix3) -> Vector3 {
    let axis = Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5;
    let (sine, cosine) = (axis.norm(), (r.trace() - 1.0) * 0.5);
    if sine < SMALL_ANGLE && cosine > 0.0 {
        return axis * (1.0 + sine * sine / 6.0);
    }
    axis * (sine.atan2(cosine) / sine)
}

/// Transpose of the left Jacobian of the rotation vector, to second order: turns a moment into the force conjugate to
/// the rotation vector `w`.
pub fn left_jacobian_transposed(w: &Vector3) -> Matrix3 {
    let k = skew(w);
    Matrix3::identity() - k * 0.5 + k * k / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_undoes_exp_at_small_and_large_angles() {
        for size in [1e-9, 1e-5, 0.99e-4, 1.01e-4, 0.3, 2.5] {
            let w = Vector3::new(0.36, -0.48, 0.8) * size;
            assert!((log(&exp(&w)) - w).norm() < 8.0 * f64::EPSILON * (1.0 + size), "{size}");
        }
    }
}
