//! Readings of one pose under one load, at four machines abreast.

use hexbench_core::{Hexapod, Matrix3, Observation, Pose, Vector6};
use wide::f64x4;

use crate::error::ModelError;
use crate::machine::kinematics::{Legs, euler_rate_matrix};
use crate::machine::lanes::{Matrix, Point, Six, dot, factor, jacobian_row, rotation, splat, substitute};

/// Readings of one pose under one load.
#[derive(Debug, Clone)]
pub(super) struct Group {
    translation: Point,
    rotation: [Point; 3],
    /// `S^-1/2`: a twist in units of the noise, lengths over the radius.
    sigma: [f64; 6],
    /// `M`: angular velocity from Euler rates.
    euler: Matrix3,
    /// `S^-1/2 E^-T (W - W0)`.
    change: Six,
    compliance: [f64; 6],
    pub(super) repeats: usize,
}

/// One pose of four machines.
pub(super) struct AtPose {
    /// `B`.
    pub(super) legs: Matrix,
    /// Cholesky factor of `T`.
    pub(super) factor: Matrix,
    /// Forces times true compliances.
    pub(super) elongations: Six,
}

impl Group {
    #[inline]
    pub(super) fn at(&self, [base, platform]: &[[Point; 6]; 2]) -> AtPose {
        let mut legs = [[f64x4::ZERO; 6]; 6];
        for (leg, row) in legs.iter_mut().enumerate() {
            let [nx, ny, nz, mx, my, mz] =
                jacobian_row(&base[leg], &platform[leg], &self.translation, &self.rotation);
            let by_euler = |k: usize| {
                let column = self.euler.column(k);
                mx * f64x4::splat(column.x) + my * f64x4::splat(column.y) + mz * f64x4::splat(column.z)
            };
            let free = [nx, ny, nz, by_euler(0), by_euler(1), by_euler(2)];
            for k in 0..6 {
                row[k] = free[k] * f64x4::splat(self.sigma[k]);
            }
        }
        let mut square = [[f64x4::ZERO; 6]; 6];
        for i in 0..6 {
            for j in 0..=i {
                square[i][j] = dot(&legs[i], &legs[j]);
            }
        }
        let factor = factor(square);
        let forces = substitute(&factor, std::array::from_fn(|leg| dot(&legs[leg], &self.change)));
        let elongations = std::array::from_fn(|leg| forces[leg] * f64x4::splat(self.compliance[leg]));
        AtPose { legs, factor, elongations }
    }
}

impl AtPose {
    /// `S^1/2 A`, columns in units of the true compliances: `B' T^-1 diag(elongations)`.
    pub(super) fn whitened(&self) -> Matrix {
        let mut rows = [[f64x4::ZERO; 6]; 6];
        for leg in 0..6 {
            let mut one = [f64x4::ZERO; 6];
            one[leg] = self.elongations[leg];
            let column = substitute(&self.factor, one);
            for (k, row) in rows.iter_mut().enumerate() {
                row[leg] = (0..6).fold(f64x4::ZERO, |sum, i| sum + self.legs[i][k] * column[i]);
            }
        }
        rows
    }
}

/// Readings that differ in noise only, put together.
pub(super) fn groups(
    hexapod: &Hexapod,
    readings: &[Observation],
    sigma: &[f64; 6],
    stiffness: &[f64; 6],
    radius: f64,
) -> Result<Vec<Group>, ModelError> {
    let change = |o: &Observation| o.wrench.to_vector() - o.reference.to_vector();
    let mut counted: Vec<(Pose, Vector6, usize)> = Vec::new();
    for o in readings {
        match counted.iter_mut().find(|(pose, w, _)| *pose == o.pose && *w == change(o)) {
            Some((_, _, repeats)) => *repeats += 1,
            None => counted.push((o.pose, change(o), 1)),
        }
    }
    if counted.is_empty() {
        return Err(ModelError::TooFewEquations { equations: 0, unknowns: 6 });
    }
    let group = |(pose, change, repeats): (Pose, Vector6, usize)| {
        // A singular pose is found here rather than as numbers that are not finite.
        Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &pose)?;
        let euler = euler_rate_matrix(&pose.angles);
        // Euler angles have no rates at beta = 90 deg.
        euler.try_inverse().ok_or(ModelError::SingularPose { pose, has_no_height: false })?;
        // Lengths, arms of moments among them, over the radius; rotations as they are.
        let sigma: [f64; 6] = std::array::from_fn(|i| if i < 3 { sigma[i] / radius } else { sigma[i] });
        let moment = euler.tr_mul(&change.fixed_rows::<3>(3)) / radius;
        Ok(Group {
            translation: splat(&(pose.translation / radius)),
            rotation: rotation(&splat(&pose.angles)),
            sigma,
            euler,
            change: std::array::from_fn(|i| {
                f64x4::splat(sigma[i] * if i < 3 { change[i] } else { moment[i - 3] })
            }),
            compliance: stiffness.map(|k| 1.0 / (k * radius)),
            repeats,
        })
    };
    counted.into_iter().map(group).collect()
}
