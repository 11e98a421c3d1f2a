//! Six leg springs, first order, in closed form with exact derivatives.
//!
//! ```text
//! A = W E P diag(g)         P = L^-1, f = P' dW, g = s f, E = diag(I, M^-1)
//! ```
//!
//! `dW` is the change of the wrench, `W` the weights of the rows, `s` the units of the columns, `M` the matrix from Euler rates to
//! angular velocity. Derivatives of `trace(G A'A)` go backwards: with `H = G o g g'`, `K = E'W'W E`, `B = K P H` and
//! `v_i = 2 s_i sum_j G_ij g_j (P'K P)_ij` its slope by `L` is
//!
//! ```text
//! S = -2 P'B P' - f (P v)'
//! ```
//!
//! summed over the readings, and its derivative by a change `D` of `dW` is `v' P' D`; a row `[u', w']` of it acts on the leg as the force `y = (I - n n') (u + w x a) / q` on its platform
//! end and the moment `a x (y + n x w)`. Source: Kalas et al. 2018, eq. 12 and 13; the derivatives are our own.

use hexbench_core::{Hexapod, Matrix3, Matrix6, Pose, Vector3, Vector6};
use hexbench_model::machine::kinematics::{Legs, euler_rate_matrix};
use nalgebra::DMatrix;

use super::{PoseRegressor, SettingRegressor, leg_names};
use crate::DesignError;
use crate::space::Setting;

/// Weights of the rows and units of the columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Of a translation row, 1/m.
    pub translation: f64,
    /// Of a rotation row, 1/rad.
    pub rotation: f64,
    /// Unit of each column: the compliance (m/N) that counts as one.
    pub compliance: [f64; 6],
}

impl Weights {
    /// As the paper: meters and radians side by side, compliances in m/N.
    pub const UNWEIGHTED: Self = Self { translation: 1.0, rotation: 1.0, compliance: [1.0; 6] };
}

/// Readings of one pose under every setting, for the compliances of the six legs.
#[derive(Debug, Clone)]
pub struct SpringRegressor<'a> {
    hexapod: &'a Hexapod,
    changes: Vec<Vector6>,
    counts: Vec<usize>,
    weights: Weights,
}

/// Everything about one pose that the rows need.
struct AtPose {
    legs: Legs,
    euler: Matrix3,
    inverse_euler: Matrix3,
    rows: Vector6,
}

impl<'a> SpringRegressor<'a> {
    /// Readings at each pose: `repeats` under every setting.
    pub fn new(hexapod: &'a Hexapod, settings: &[Setting], repeats: usize, weights: Weights) -> Self {
        Self { hexapod, changes: changes(settings), counts: vec![repeats; settings.len()], weights }
    }

    /// Changes of wrench that are read, and how often.
    fn read(&self) -> impl Iterator<Item = (&Vector6, f64)> {
        let counted = self.changes.iter().zip(&self.counts).filter(|(_, count)| **count > 0);
        counted.map(|(change, &count)| (change, count as f64))
    }

    fn at(&self, pose: &Pose) -> Result<AtPose, DesignError> {
        let legs = Legs::at(&self.hexapod.base_joints, &self.hexapod.platform_joints, pose)?;
        let euler = euler_rate_matrix(&pose.angles);
        let inverse_euler = euler
            .try_inverse()
            .ok_or_else(|| DesignError::Bad("at beta = 90 deg Euler angles have no rates".to_owned()))?;
        let (t, r) = (self.weights.translation, self.weights.rotation);
        Ok(AtPose { legs, euler, inverse_euler, rows: Vector6::new(t, t, t, r, r, r) })
    }

    /// `A` (6x6) of one change of wrench.
    fn block(&self, at: &AtPose, change: &Vector6) -> Matrix6 {
        let forces = at.legs.forces(change);
        let mut a = at.legs.platform_jacobian;
        let turned = at.inverse_euler * a.fixed_rows::<3>(3);
        a.fixed_rows_mut::<3>(3).copy_from(&turned);
        Matrix6::from_fn(|i, j| a[(i, j)] * at.rows[i] * forces[j] * self.weights.compliance[j])
    }

    /// `s`.
    fn units(&self) -> Vector6 {
        Vector6::from(self.weights.compliance)
    }

    /// `v`, the slope by the leg forces of `count` readings, with `G o (P'K P)` and the column `g`.
    fn by_forces(&self, weighed: &Matrix6, column: &Vector6, count: f64) -> Vector6 {
        let v = weighed * column;
        Vector6::from_fn(|i, _| 2.0 * count * self.weights.compliance[i] * v[i])
    }

    /// `K`: what a squared deviation of the platform weighs, in twists.
    fn metric(&self, at: &AtPose) -> Matrix6 {
        let (t, r) = (self.weights.translation.powi(2), self.weights.rotation.powi(2));
        let mut metric = Matrix6::zeros();
        metric.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(t);
        metric.fixed_view_mut::<3, 3>(3, 3).copy_from(&(at.inverse_euler.tr_mul(&at.inverse_euler) * r));
        metric
    }
}

fn changes(settings: &[Setting]) -> Vec<Vector6> {
    settings.iter().map(|s| s.loading.load.to_vector() - s.loading.reference.to_vector()).collect()
}

/// Force and moment on the platform that stand for the slope of a function by the leg Jacobian.
fn wrench_of(at: &AtPose, slope: &Matrix6) -> (Vector3, Vector3) {
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    for i in 0..6 {
        let (n, arm) = (at.legs.directions[i], at.legs.arms[i]);
        let u = Vector3::new(slope[(i, 0)], slope[(i, 1)], slope[(i, 2)]);
        let w = Vector3::new(slope[(i, 3)], slope[(i, 4)], slope[(i, 5)]);
        let z = u + w.cross(&arm);
        let y = (z - n * n.dot(&z)) / at.legs.lengths[i];
        force += y;
        moment += arm.cross(&(y + n.cross(&w)));
    }
    (force, moment)
}

/// Derivative of the Euler rate matrix by beta (k = 4) or gamma (k = 5).
fn euler_rate_slope(angles: &Vector3, k: usize) -> Matrix3 {
    let (sb, cb) = angles.y.sin_cos();
    let (sg, cg) = angles.z.sin_cos();
    if k == 4 {
        Matrix3::new(-cg * sb, 0.0, 0.0, -sg * sb, 0.0, 0.0, -cb, 0.0, 0.0)
    } else {
        Matrix3::new(-sg * cb, -cg, 0.0, cg * cb, -sg, 0.0, 0.0, 0.0, 0.0)
    }
}

impl PoseRegressor for SpringRegressor<'_> {
    fn parameters(&self) -> usize {
        6
    }

    fn readings(&self) -> usize {
        self.counts.iter().sum()
    }

    fn names(&self) -> Vec<String> {
        leg_names()
    }

    fn inform(&self, pose: &Pose, information: &mut DMatrix<f64>) -> Result<(), DesignError> {
        let at = self.at(pose)?;
        for (change, count) in self.read() {
            let a = self.block(&at, change);
            let mut whole = information.fixed_view_mut::<6, 6>(0, 0);
            whole += a.tr_mul(&a) * count;
        }
        Ok(())
    }

    fn slopes(&self, pose: &Pose, g: &DMatrix<f64>) -> Result<[f64; 6], DesignError> {
        let at = self.at(pose)?;
        let g = g.fixed_view::<6, 6>(0, 0);
        let (p, metric) = (&at.legs.platform_jacobian, self.metric(&at));
        let heavy = metric * p;
        let square = p.tr_mul(&heavy);
        let (mut h, mut slope) = (Matrix6::zeros(), Matrix6::zeros());
        for (change, count) in self.read() {
            let f = at.legs.forces(change);
            let column = f.component_mul(&self.units());
            h += g.component_mul(&(column * column.transpose())) * count;
            slope -= f * (p * self.by_forces(&g.component_mul(&square), &column, count)).transpose();
        }
        let twice = heavy * h * 2.0;
        slope -= p.tr_mul(&(twice * p.transpose()));
        let (force, moment) = wrench_of(&at, &slope);
        let turned = at.euler.tr_mul(&moment);
        let rotations = p.fixed_rows::<3>(3);
        let spread =
            at.inverse_euler * (rotations * h * rotations.transpose()) * at.inverse_euler.transpose();
        let by_euler = |k| {
            let rates = at.inverse_euler * euler_rate_slope(&pose.angles, k);
            -2.0 * self.weights.rotation.powi(2) * (rates * spread).trace()
        };
        Ok([force.x, force.y, force.z, turned.x, turned.y + by_euler(4), turned.z + by_euler(5)])
    }

    fn load_slope(&self, pose: &Pose, g: &DMatrix<f64>, directions: &[Vector6]) -> Result<f64, DesignError> {
        let at = self.at(pose)?;
        let p = &at.legs.platform_jacobian;
        let weighed = g.fixed_view::<6, 6>(0, 0).component_mul(&p.tr_mul(&(self.metric(&at) * p)));
        let of = |((change, count), direction): ((&Vector6, &usize), &Vector6)| {
            let column = at.legs.forces(change).component_mul(&self.units());
            self.by_forces(&weighed, &column, *count as f64).dot(&at.legs.forces(direction))
        };
        Ok(self.changes.iter().zip(&self.counts).zip(directions).map(of).sum())
    }

    fn under(&self, settings: &[Setting]) -> Self {
        Self { changes: changes(settings), ..self.clone() }
    }
}

impl SettingRegressor for SpringRegressor<'_> {
    fn each(&self, pose: &Pose) -> Result<Vec<DMatrix<f64>>, DesignError> {
        let at = self.at(pose)?;
        let square = |a: Matrix6| a.tr_mul(&a);
        let of = |change| DMatrix::from_column_slice(6, 6, square(self.block(&at, change)).as_slice());
        Ok(self.changes.iter().map(of).collect())
    }

    fn repeated(&self, counts: &[usize]) -> Self {
        Self { counts: counts.to_vec(), ..self.clone() }
    }
}

#[cfg(test)]
mod tests;
