//! Poses by way of balls on the platform, as a coordinate measuring machine sees them.
//!
//! The pose is the least-squares rigid superposition of the balls' nominal places on the measured ones, by Horn's quaternion
//! (B. K. P. Horn, J. Opt. Soc. Am. A 4 (1987) 629): it is a rotation even for three balls, which are always coplanar, where the
//! singular value method returns a reflection about half the time.

use hexbench_core::{Matrix6, Pose, Vector3};
use nalgebra::{Matrix3x6, Matrix4, Quaternion, SymmetricEigen, UnitQuaternion};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::TruthError;

/// Balls fixed to the platform, and the noise of one coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Balls {
    /// Centers, mobile frame, m; at least three, not on one line.
    pub centres: Vec<Vector3>,
    /// Standard deviation of one measured coordinate, m.
    pub sigma: f64,
}

/// A pose found from balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Registration {
    /// Pose of the platform.
    pub pose: Pose,
    /// Root mean square distance between measured and superposed balls, m.
    pub rms: f64,
}

impl Balls {
    /// Three balls on a circle about z at the height of the mobile origin; radius and noise in m.
    pub fn triangle(radius: f64, sigma: f64) -> Self {
        let centre = |turn_deg: f64| {
            let (s, c) = turn_deg.to_radians().sin_cos();
            Vector3::new(radius * c, radius * s, 0.0)
        };
        Self { centres: [0.0, 120.0, 240.0].map(centre).to_vec(), sigma }
    }

    /// Measured centers with the platform at a pose, fixed frame, m.
    pub fn measure(&self, pose: &Pose, rng: &mut Pcg64) -> Vec<Vector3> {
        let r = pose.rotation();
        let mut noise = || -> Vector3 { Vector3::from_fn(|_, _| StandardNormal.sample(rng)) * self.sigma };
        self.centres.iter().map(|c| pose.translation + r * c + noise()).collect()
    }

    /// Pose that superposes the nominal centers on measured ones (fixed frame, m).
    ///
    /// # Errors
    /// [`TruthError::NotFinite`]; [`TruthError::Balls`] for too few, miscounted or aligned balls.
    pub fn register(&self, measured: &[Vector3]) -> Result<Registration, TruthError> {
        if measured.len() != self.centres.len() || measured.len() < 3 {
            return Err(TruthError::Balls { found: measured.len(), expected: self.centres.len().max(3) });
        }
        if !measured.iter().flatten().all(|x| x.is_finite()) {
            return Err(TruthError::NotFinite { what: "a ball coordinate" });
        }
        let (from, to) = (mean(&self.centres), mean(measured));
        let rotation = self.turn(measured, &from, &to)?;
        let translation = to - rotation * from;
        let miss = |(c, m): (&Vector3, &Vector3)| (translation + rotation * c - m).norm_squared();
        let sum: f64 = self.centres.iter().zip(measured).map(miss).sum();
        let pose = Pose::from_rotation(translation, rotation.to_rotation_matrix().matrix());
        Ok(Registration { pose, rms: (sum / measured.len() as f64).sqrt() })
    }

    /// First-order covariance of a pose found from these balls: translation, and rotation as a vector in fixed axes.
    ///
    /// `sigma^2 (sum J_i' J_i)^-1` with `J_i = [I, -[R c_i]]`, the motion of ball i per motion of the platform.
    ///
    /// # Errors
    /// [`TruthError::Balls`] for balls that do not determine a pose.
    pub fn covariance(&self, pose: &Pose) -> Result<Matrix6, TruthError> {
        let r = pose.rotation();
        let mut normal = Matrix6::zeros();
        for centre in &self.centres {
            let mut motion = Matrix3x6::zeros();
            motion.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&-(r * centre).cross_matrix());
            normal += motion.tr_mul(&motion);
        }
        let found = self.centres.len();
        let inverse = normal.cholesky().ok_or(TruthError::Balls { found, expected: found.max(3) })?.inverse();
        Ok(inverse * (self.sigma * self.sigma))
    }

    /// Eigenvector of Horn's matrix that belongs to its largest eigenvalue.
    fn turn(
        &self,
        measured: &[Vector3],
        from: &Vector3,
        to: &Vector3,
    ) -> Result<UnitQuaternion<f64>, TruthError> {
        const ALIGNED: f64 = 1e-9;
        let mut horn = Matrix4::zeros();
        for (c, m) in self.centres.iter().zip(measured) {
            horn += horn_term(&(c - from), &(m - to));
        }
        let eigen = SymmetricEigen::new(horn);
        let mut order = [0, 1, 2, 3];
        order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
        let (first, second) = (eigen.eigenvalues[order[0]], eigen.eigenvalues[order[1]]);
        if first - second <= ALIGNED * first.abs() {
            return Err(TruthError::Balls { found: measured.len(), expected: self.centres.len().max(3) });
        }
        let q = eigen.eigenvectors.column(order[0]);
        Ok(UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3])))
    }
}

/// What one pair of points adds to Horn's matrix, scalar part first.
fn horn_term(a: &Vector3, b: &Vector3) -> Matrix4<f64> {
    let s = a * b.transpose();
    let (trace, antisymmetric) = (s.trace(), a.cross(b));
    let mut m = Matrix4::zeros();
    m[(0, 0)] = trace;
    for i in 0..3 {
        m[(0, i + 1)] = antisymmetric[i];
        m[(i + 1, 0)] = antisymmetric[i];
        for j in 0..3 {
            m[(i + 1, j + 1)] = s[(i, j)] + s[(j, i)] - if i == j { trace } else { 0.0 };
        }
    }
    m
}

fn mean(points: &[Vector3]) -> Vector3 {
    points.iter().sum::<Vector3>() / points.len() as f64
}

#[cfg(test)]
mod tests {
    use hexbench_core::streams::{Purpose, stream};

    use super::*;

    fn pose() -> Pose {
        Pose::from_array([0.02, -0.01, 0.3, 0.2, -0.3, 2.8])
    }

    #[test]
    fn three_balls_without_noise_give_the_pose_and_no_reflection() {
        let balls = Balls::triangle(0.12, 0.0);
        let found = balls.register(&balls.measure(&pose(), &mut stream(1, Purpose::Test, [1]))).unwrap();
        assert!((found.pose.to_vector() - pose().to_vector()).amax() < 1e-13, "{found:?}");
        assert!(found.rms < 1e-15);
    }

    /// Three balls on radius r with noise s a coordinate: a difference of two poses has s sqrt(2/3) in translation,
    /// s sqrt(2) / (r sqrt(1.5)) about x and y, s sqrt(2) / (r sqrt(3)) about z: 0.82 um and 9.6, 9.6, 6.8 urad.
    #[test]
    fn noise_of_a_deflection_is_that_of_the_closed_form() {
        const PAIRS: u32 = 4000;
        let balls = Balls::triangle(0.12, 1e-6);
        let (rest, mut rng) = (Pose::default(), stream(2, Purpose::Test, [2]));
        let mut read = || balls.register(&balls.measure(&rest, &mut rng)).unwrap().pose.to_vector();
        let sums = (0..PAIRS).map(|_| (read() - read()).map(|x| x * x)).sum::<hexbench_core::Vector6>();
        let found = (sums / f64::from(PAIRS)).map(f64::sqrt) * 1e6;
        let expected = [0.816, 0.816, 0.816, 9.62, 9.62, 6.80];
        for k in 0..6 {
            assert!(
                (found[k] / expected[k] - 1.0).abs() < 4.5 / f64::from(2 * PAIRS).sqrt(),
                "{k}: {}",
                found[k]
            );
        }
    }

    #[test]
    fn balls_on_a_line_or_missing_are_refused() {
        let line = Balls { centres: (0..3).map(|i| Vector3::x() * f64::from(i)).collect(), sigma: 0.0 };
        let seen = line.measure(&pose(), &mut stream(1, Purpose::Test, [1]));
        assert!(matches!(line.register(&seen), Err(TruthError::Balls { .. })));
        assert!(matches!(line.register(&seen[..2]), Err(TruthError::Balls { found: 2, .. })));
    }
}
