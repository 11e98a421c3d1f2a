//! Natural modes of a machine on its leg springs.

use hexbench_core::{Matrix3, Matrix6, Vector6};
use hexbench_truth::{Setup, equilibrium::Body, so3};
use nalgebra::SymmetricEigen;

use crate::{masses::leg_stiffness, parts::Inertia};

/// Natural modes: `K x = omega^2 M x`, lowest first.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Angular frequencies `omega`, rad/s.
    pub angular_frequencies: [f64; 6],
    /// Mode shapes as columns (translation m, rotation vector rad; mobile origin, fixed axes), `X' M X = 1`.
    pub shapes: Matrix6,
    /// Mass matrix `M`.
    pub mass: Matrix6,
    /// Stiffness matrix `K`.
    pub stiffness: Matrix6,
}

impl Modes {
    /// Small motions about the commanded pose: linear leg springs, a platform of some inertia, legs as uniform rods of the
    /// given mass (kg) that follow their platform joint.
    ///
    /// A leg adds `m/2` along its direction (its upper half) and `m/3` across it (the whole, about the base joint), at
    /// its platform joint. None when a matrix is not positive, so that no mode exists.
    pub fn of(setup: &Setup, platform: &Inertia, leg_mass: f64) -> Option<Self> {
        let place = Body::at(&setup.pose);
        let stiffness = leg_stiffness(setup, &std::array::from_fn(|i| 1.0 / setup.laws[i].compliance));
        let mut mass = platform.matrix(&place.axes);
        for i in 0..6 {
            let arm = place.axes * setup.platform_joints[i];
            let n = (place.origin + arm - setup.base_joints[i]).normalize();
            let along = n * n.transpose();
            let at_joint = along * (leg_mass / 2.0) + (Matrix3::identity() - along) * (leg_mass / 3.0);
            mass += carried(&at_joint, &so3::skew(&arm));
        }
        let (squares, shapes) = generalized(&stiffness, &mass)?;
        let angular_frequencies = squares.map(f64::sqrt);
        angular_frequencies.iter().all(|w| *w > 0.0).then_some(Self {
            angular_frequencies,
            shapes,
            mass,
            stiffness,
        })
    }

    /// Natural frequencies, Hz.
    pub fn frequencies_hz(&self) -> [f64; 6] {
        self.angular_frequencies.map(|w| w / std::f64::consts::TAU)
    }
}

/// Mass matrix about the mobile origin of a mass matrix at an arm (given as its cross-product matrix).
fn carried(at_joint: &Matrix3, arm: &Matrix3) -> Matrix6 {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(at_joint);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-at_joint * arm));
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&(arm * at_joint));
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-arm * at_joint * arm));
    matrix
}

/// Eigenvalues of `K x = lambda M x`, ascending; NaN when `M` is not positive.
pub fn eigenvalues(k: &Matrix6, m: &Matrix6) -> [f64; 6] {
    generalized(k, m).map_or([f64::NAN; 6], |(values, _)| values)
}

/// Eigenvalues, ascending, and vectors with `X' M X = 1`.
fn generalized(k: &Matrix6, m: &Matrix6) -> Option<([f64; 6], Matrix6)> {
    let inverse = m.cholesky()?.l().try_inverse()?;
    let reduced = inverse * k * inverse.transpose();
    let eigen = SymmetricEigen::new((reduced + reduced.transpose()) * 0.5);
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let columns: [Vector6; 6] = order.map(|i| inverse.tr_mul(&eigen.eigenvectors.column(i)));
    Some((order.map(|i| eigen.eigenvalues[i]), Matrix6::from_columns(&columns)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_solve_their_equation_and_are_normal_to_each_other() {
        let a = Matrix6::from_fn(|i, j| ((i * 7 + j * 3) as f64).sin() + if i == j { 3.0 } else { 0.0 });
        let b = Matrix6::from_fn(|i, j| ((i * 5 + j * 2) as f64).cos() + if i == j { 4.0 } else { 0.0 });
        let (k, m) = (a * a.transpose(), b * b.transpose());
        let (values, shapes) = generalized(&k, &m).unwrap();
        let error = (k * shapes - m * shapes * Matrix6::from_diagonal(&Vector6::from(values))).amax();
        assert!(error < 1e-11 * k.amax(), "{error:.1e}");
        assert!((shapes.transpose() * m * shapes - Matrix6::identity()).amax() < 1e-12);
    }
}
