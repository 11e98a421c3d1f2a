//! The pose of the platform.

use crate::{Matrix3, Vector3, Vector6};

/// Pose of the mobile frame in the fixed frame: translation in m, extrinsic X-Y-Z angles in rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// `[a, b, c]`: position of the mobile origin, fixed frame, m.
    pub translation: Vector3,
    /// `[alpha, beta, gamma]`: extrinsic X-Y-Z angles, rad.
    pub angles: Vector3,
}

/// Cosine of beta below which rounding of a rotation matrix spoils alpha and gamma taken alone.
const NEARLY_UPRIGHT: f64 = 1e-3;

impl Pose {
    /// A pose from `[a, b, c, alpha, beta, gamma]` in m and rad.
    pub fn from_array(x: [f64; 6]) -> Self {
        Self { translation: Vector3::new(x[0], x[1], x[2]), angles: Vector3::new(x[3], x[4], x[5]) }
    }

    /// `[a, b, c, alpha, beta, gamma]` in m and rad.
    pub fn to_array(self) -> [f64; 6] {
        [
            self.translation.x,
            self.translation.y,
            self.translation.z,
            self.angles.x,
            self.angles.y,
            self.angles.z,
        ]
    }

    /// Its bits: readings at poses of equal bits are readings at one pose.
    pub fn bits(self) -> [u64; 6] {
        // Zero has two signs.
        self.to_array().map(|x| (x + 0.0).to_bits())
    }

    /// A pose from a translation and a rotation matrix.
    ///
    /// Limits: at `beta = +-90 deg` alpha and gamma are not separable; gamma is then set to zero.
    pub fn from_rotation(translation: Vector3, r: &Matrix3) -> Self {
        let upright = r[(0, 0)].hypot(r[(1, 0)]);
        let beta = (-r[(2, 0)]).atan2(upright);
        let (alpha, gamma) = if upright > NEARLY_UPRIGHT {
            (r[(2, 1)].atan2(r[(2, 2)]), r[(1, 0)].atan2(r[(0, 0)]))
        } else if upright > 1e-12 {
            // Rounding spoils alpha here; gamma makes up for whatever alpha is, so that together they are the rotation.
            let alpha = r[(2, 1)].atan2(r[(2, 2)]);
            let (sine, cosine) = alpha.sin_cos();
            let across = sine * r[(0, 2)] - cosine * r[(0, 1)];
            (alpha, across.atan2(cosine * r[(1, 1)] - sine * r[(1, 2)]))
        } else {
            ((-r[(1, 2)]).atan2(r[(1, 1)]), 0.0)
        };
        Self { translation, angles: Vector3::new(alpha, beta, gamma) }
    }

    /// `R = Rz(gamma) Ry(beta) Rx(alpha)`: mobile axes to fixed axes.
    pub fn rotation(&self) -> Matrix3 {
        let (sa, ca) = self.angles.x.sin_cos();
        let (sb, cb) = self.angles.y.sin_cos();
        let (sg, cg) = self.angles.z.sin_cos();
        Matrix3::new(
            cg * cb,
            cg * sb * sa - sg * ca,
            cg * sb * ca + sg * sa,
            sg * cb,
            sg * sb * sa + cg * ca,
            sg * sb * ca - cg * sa,
            -sb,
            cb * sa,
            cb * ca,
        )
    }

    /// The pose as one vector `[a, b, c, alpha, beta, gamma]`.
    pub fn to_vector(self) -> Vector6 {
        Vector6::from_column_slice(&self.to_array())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_and_angles_are_inverse() {
        let pose = Pose::from_array([0.1, -0.2, 0.3, 0.4, -0.5, 2.6]);
        let back = Pose::from_rotation(pose.translation, &pose.rotation());
        assert!((back.to_vector() - pose.to_vector()).amax() < 8.0 * f64::EPSILON * 2.6);
    }

    #[test]
    fn rotation_is_extrinsic_x_then_y_then_z() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let pose = Pose::from_array([0.0, 0.0, 0.0, quarter, 0.0, quarter]);
        // y -> z by the turn about x, then z stays under the turn about z.
        assert!((pose.rotation() * Vector3::y() - Vector3::z()).norm() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn near_the_lock_the_angles_are_still_the_rotation() {
        for off in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
            for side in [1.0, -1.0] {
                let beta = side * (std::f64::consts::FRAC_PI_2 - off);
                let pose = Pose::from_array([0.0, 0.0, 0.0, 0.3, beta, 2.7]);
                let error = (Pose::from_rotation(pose.translation, &pose.rotation()).rotation()
                    - pose.rotation())
                .amax();
                assert!(error < 3e-12, "{off}: {error}");
            }
        }
    }

    #[test]
    fn upright_lock_keeps_the_rotation() {
        let pose = Pose::from_array([0.0, 0.0, 0.0, 0.3, std::f64::consts::FRAC_PI_2, 0.7]);
        let back = Pose::from_rotation(pose.translation, &pose.rotation());
        assert!((back.rotation() - pose.rotation()).amax() < 1e-12);
    }
}
