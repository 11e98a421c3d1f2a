//! The 42 numbers of the geometry, and which combinations of them absolute poses determine.
//!
//! Moving all base joints as one rigid body is the same as moving the metrology frame the other way, and moving all platform
//! joints the same as moving the target frame: six and six combinations that no absolute pose shows. The estimate leaves them
//! near the drawing, where its prior holds them; the world's are wherever they were drawn. The truth is therefore brought to
//! the estimate by the two rigid motions that fit best (exactly the same machine, seen from other frames), and what is compared
//! are the combinations that the data determine: eigenvectors of the covariance along which it is small against the prior.
//!
//! One thing is not the same in other frames: which way the load points and where it acts. A tilt of all base joints by 1e-3 rad
//! turns a vertical load by as much against the legs, and a shift of all platform joints moves its point of action. Loaded
//! poses give a hint of these five; the other seven (shifts of the base, its rotation about the load, rotations of the
//! platform) never show.

use hexbench_core::Vector3;
use hexbench_core::statistics::root_mean_square;
use hexbench_model::estimation::fit::Fit;
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen};

use super::scene::RecoveryCampaign;

/// A combination counts as determined when its standard uncertainty is below this share of its prior width.
const DETERMINED: f64 = 0.05;

/// The determined combinations, and the count of the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Combinations {
    /// Estimate minus truth and its standard uncertainty, both relative to the root mean square of the true numbers.
    pub misses: Vec<[f64; 2]>,
    /// Combinations that the data leave open.
    pub open: usize,
}

impl Combinations {
    /// Estimate minus truth in standard uncertainties, one per determined combination.
    pub fn pulls(&self) -> impl Iterator<Item = f64> {
        self.misses.iter().map(|[miss, std]| miss / std)
    }
}

/// Compares the geometry of a fit with the truth of its scene; `None` when no joints were fitted.
pub fn combinations(scene: &RecoveryCampaign, fit: &Fit) -> Option<Combinations> {
    let truth = truth(scene, fit)?;
    let columns: Vec<usize> = geometry_columns(fit);
    let estimate: Vec<f64> = geometry_values(fit);
    let width = |k: usize| fit.parameters[k].prior.map_or(f64::INFINITY, |p| p.width);
    let miss = DVector::from_fn(columns.len(), |k, _| (estimate[k] - truth[k]) / width(columns[k]));
    let covariance = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
        fit.covariance[(columns[i], columns[j])] / (width(columns[i]) * width(columns[j]))
    });
    let eigen = SymmetricEigen::new(covariance);
    let spread: Vec<f64> = eigen.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).collect();
    let size = root_mean_square(truth.iter().copied())?;
    let unit = width(columns[0]) / size;
    let of = |k: usize| [eigen.eigenvectors.column(k).dot(&miss) * unit, spread[k] * unit];
    let (determined, open): (Vec<usize>, Vec<usize>) =
        (0..spread.len()).partition(|&k| spread[k] > 0.0 && spread[k] < DETERMINED);
    Some(Combinations { misses: determined.into_iter().map(of).collect(), open: open.len() })
}

fn is_geometry(id: &str) -> bool {
    matches!(id, "joint-geometry" | "leg-offset")
}

fn geometry_columns(fit: &Fit) -> Vec<usize> {
    let terms = (0..fit.point.active.len()).filter(|&k| is_geometry(fit.point.active[k].id()));
    terms.flat_map(|k| fit.parameters.values_of_term(k)).collect()
}

fn geometry_values(fit: &Fit) -> Vec<f64> {
    fit.point.active.iter().filter(|a| is_geometry(a.id())).flat_map(|a| a.values.iter().copied()).collect()
}

/// True values in the order of the fit's columns, joints brought to those estimated, m.
fn truth(scene: &RecoveryCampaign, fit: &Fit) -> Option<Vec<f64>> {
    let known = scene.equivalents();
    let mut all = Vec::new();
    let mut joints = false;
    for a in fit.point.active.iter().filter(|a| is_geometry(a.id())) {
        let (_, equivalent) = known.iter().find(|(id, _)| *id == a.id())?;
        let values: Vec<f64> = equivalent.values.iter().copied().collect::<Option<_>>()?;
        if a.id() == "joint-geometry" {
            joints = true;
            let hexapod = scene.hexapod();
            all.extend(brought(&hexapod.base_joints, &values[..18], &a.values[..18]));
            all.extend(brought(&hexapod.platform_joints, &values[18..], &a.values[18..]));
        } else {
            all.extend(values);
        }
    }
    joints.then_some(all)
}

/// Errors of joints after the rigid motion that brings the true joints closest to the estimated ones.
fn brought(nominal: &[Vector3; 6], truth: &[f64], estimate: &[f64]) -> Vec<f64> {
    let places = |errors: &[f64]| -> Vec<Vector3> {
        nominal.iter().zip(errors.chunks_exact(3)).map(|(n, e)| n + Vector3::from_column_slice(e)).collect()
    };
    let moved = superposed(&places(truth), &places(estimate));
    moved.iter().zip(nominal).flat_map(|(m, n)| (m - n).iter().copied().collect::<Vec<_>>()).collect()
}

/// Points rigidly moved onto others with the least sum of squares (Kabsch 1976, Acta Cryst. A 32).
fn superposed(points: &[Vector3], onto: &[Vector3]) -> Vec<Vector3> {
    let mean = |p: &[Vector3]| p.iter().sum::<Vector3>() / p.len() as f64;
    let (from, to) = (mean(points), mean(onto));
    let correlation: Matrix3<f64> =
        points.iter().zip(onto).map(|(p, q)| (q - to) * (p - from).transpose()).sum();
    let svd = correlation.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return points.to_vec() };
    let proper = (u * v_t).determinant().signum();
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, proper)) * v_t;
    points.iter().map(|p| to + rotation * (p - from)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_moved_rigidly_are_brought_back() {
        const ROUNDING_M: f64 = 1e-15;
        let points: Vec<Vector3> = (0..6)
            .map(|i| Vector3::new(f64::from(i).sin(), f64::from(i).cos(), 0.1 * f64::from(i * i)))
            .collect();
        let turn = nalgebra::Rotation3::new(Vector3::new(0.1, -0.2, 0.3));
        let moved: Vec<Vector3> = points.iter().map(|p| turn * p + Vector3::new(1.0, 2.0, 3.0)).collect();
        let miss =
            superposed(&points, &moved).iter().zip(&moved).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(miss < 10.0 * ROUNDING_M, "{miss:.1e} m");
    }
}
