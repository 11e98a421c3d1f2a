//! One rigid superposition and its covariance.

use hexbench_core::{Matrix3, Matrix6, Vector3};
use nalgebra::SVD;

/// Second singular value below this share of the first: the points lie on a line.
const ON_A_LINE: f64 = 1e-9;
/// Iterations of the singular value decomposition before giving up; three by three needs a handful.
const MOST_ITERATIONS: usize = 200;

/// Motion that carries known places to measured ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Rigid {
    /// Translation, m.
    pub translation: Vector3,
    /// Rotation matrix.
    pub rotation: Matrix3,
    /// Covariance of translation and rotation vector (fixed axes) for coordinates of unit variance.
    pub cofactors: Matrix6,
    /// Measured minus carried places, m.
    pub residuals: Vec<Vector3>,
}

impl Rigid {
    /// Coordinates measured beyond the six that the motion takes.
    pub fn degrees_of_freedom(&self) -> usize {
        3 * self.residuals.len() - 6
    }

    /// Sum of squared residuals, m^2.
    pub fn sum_of_squares(&self) -> f64 {
        self.residuals.iter().map(Vector3::norm_squared).sum()
    }
}

/// The least-squares motion; none for fewer than three points, points on a line, or numbers that are not finite.
pub fn rigid(known: &[Vector3], measured: &[Vector3]) -> Option<Rigid> {
    let finite = known.iter().chain(measured).all(|p| p.iter().all(|x| x.is_finite()));
    if known.len() != measured.len() || known.len() < 3 || !finite || is_line(known) || is_line(measured) {
        return None;
    }
    let (from, to) = (mean(known), mean(measured));
    let correlation: Matrix3 =
        known.iter().zip(measured).map(|(c, m)| (m - to) * (c - from).transpose()).sum();
    let svd = SVD::try_new(correlation, true, true, f64::EPSILON, MOST_ITERATIONS)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let smallest = svd.singular_values.imin();
    let mut sides = Vector3::repeat(1.0);
    sides[smallest] = (u * v_t).determinant().signum();
    let rotation = u * Matrix3::from_diagonal(&sides) * v_t;
    let translation = to - rotation * from;
    let carried: Vec<Vector3> = known.iter().map(|c| translation + rotation * c).collect();
    let residuals = measured.iter().zip(&carried).map(|(m, c)| m - c).collect();
    let arms: Vec<Vector3> = carried.iter().map(|c| c - translation).collect();
    Some(Rigid { translation, rotation, cofactors: cofactors(&arms)?, residuals })
}

/// Inverse of the normal equations, in closed form: about their center the points turn with their inertia, apart from the
/// translation; the rotation then carries the center to the mobile origin.
fn cofactors(arms: &[Vector3]) -> Option<Matrix6> {
    let centre = mean(arms);
    let inertia: Matrix3 = arms
        .iter()
        .map(|arm| arm - centre)
        .map(|r| Matrix3::identity() * r.norm_squared() - r * r.transpose())
        .sum();
    let turning = inertia.try_inverse()?;
    let carry = centre.cross_matrix();
    let moving = Matrix3::identity() / arms.len() as f64 + carry * turning * carry.transpose();
    let mixed = carry * turning;
    let mut all = Matrix6::zeros();
    all.fixed_view_mut::<3, 3>(0, 0).copy_from(&moving);
    all.fixed_view_mut::<3, 3>(0, 3).copy_from(&mixed);
    all.fixed_view_mut::<3, 3>(3, 0).copy_from(&mixed.transpose());
    all.fixed_view_mut::<3, 3>(3, 3).copy_from(&turning);
    Some(all)
}

fn mean(points: &[Vector3]) -> Vector3 {
    points.iter().sum::<Vector3>() / points.len() as f64
}

fn is_line(points: &[Vector3]) -> bool {
    let centre = mean(points);
    let farthest = points.iter().map(|p| p - centre).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let Some(direction) = farthest.filter(|d| d.norm() > 0.0) else { return true };
    let aside = |p: &Vector3| (p - centre).cross(&direction).norm() / direction.norm_squared();
    points.iter().map(aside).fold(0.0, f64::max) < ON_A_LINE
}

#[cfg(test)]
mod tests {
    use hexbench_core::Pose;

    use super::*;

    fn triangle() -> Vec<Vector3> {
        [[0.12, 0.0, 0.0], [-0.06, 0.104, 0.0], [-0.06, -0.104, 0.0]].map(Vector3::from).to_vec()
    }

    fn carried(pose: &Pose, places: &[Vector3]) -> Vec<Vector3> {
        places.iter().map(|c| pose.translation + pose.rotation() * c).collect()
    }

    #[test]
    fn what_is_left_is_the_sum_of_all_squares_beside_the_coordinates_that_are_left_over() {
        let known = [[0.1, 0.0, 0.0], [-0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, -0.1, 0.0]].map(Vector3::from);
        // A square bent by 1 mm: no motion takes any of it up.
        let bent = [1e-3, 1e-3, -1e-3, -1e-3];
        let measured: Vec<Vector3> = known.iter().zip(bent).map(|(p, z)| p + Vector3::z() * z).collect();
        let found = rigid(&known, &measured).unwrap();
        assert_eq!(found.degrees_of_freedom(), 6);
        assert!((found.sum_of_squares() - 4e-6).abs() < 1e-15, "{}", found.sum_of_squares());
    }

    #[test]
    fn three_balls_give_a_rotation_and_never_a_reflection() {
        for turn in -20..=20 {
            let angle = f64::from(turn) * 0.15;
            let pose = Pose::from_array([0.3, -0.2, 0.1, 0.7 * angle, 0.3 - 0.4 * angle, angle]);
            let found = rigid(&triangle(), &carried(&pose, &triangle())).unwrap();
            assert!((found.rotation - pose.rotation()).amax() < 1e-12, "{turn}: {}", found.rotation);
            assert!((found.translation - pose.translation).amax() < 1e-13);
            assert!(found.sum_of_squares().sqrt() < 1e-14);
        }
    }

    /// Central differences of the motion by each measured coordinate: `sum J J'` is what unit noise makes of it.
    #[test]
    fn cofactors_agree_with_differences() {
        const STEP: f64 = 1e-6;
        let places =
            [[0.1, 0.02, 0.03], [-0.07, 0.1, 0.0], [0.0, -0.12, 0.05], [0.04, 0.0, 0.2]].map(Vector3::from);
        let measured = carried(&Pose::from_array([0.2, 0.1, -0.3, 0.4, -0.5, 1.6]), &places);
        let at_rest = rigid(&places, &measured).unwrap();
        let mut sum = Matrix6::zeros();
        for k in 0..12 {
            let moved = |step: f64| {
                let mut points = measured.clone();
                points[k / 3][k % 3] += step;
                rigid(&places, &points).unwrap()
            };
            let (plus, minus) = (moved(STEP), moved(-STEP));
            let turn = (plus.rotation - minus.rotation) * at_rest.rotation.transpose() / (2.0 * STEP);
            let shift = (plus.translation - minus.translation) / (2.0 * STEP);
            let twist = hexbench_core::Vector6::new(
                shift.x,
                shift.y,
                shift.z,
                turn[(2, 1)],
                turn[(0, 2)],
                turn[(1, 0)],
            );
            sum += twist * twist.transpose();
        }
        let error = (sum - at_rest.cofactors).amax() / at_rest.cofactors.amax();
        assert!(error < 1e-7, "{error}");
    }

    #[test]
    fn what_determines_no_pose_is_refused() {
        let line: Vec<Vector3> = (0..4).map(|i| Vector3::new(0.1, 0.2, 0.3) * f64::from(i)).collect();
        assert_eq!(rigid(&line, &line), None);
        assert_eq!(rigid(&triangle()[..2], &triangle()[..2]), None);
        let mut broken = triangle();
        broken[0].x = f64::NAN;
        assert_eq!(rigid(&triangle(), &broken), None);
        assert_eq!(rigid(&[Vector3::zeros(); 3], &[Vector3::zeros(); 3]), None);
    }
}
