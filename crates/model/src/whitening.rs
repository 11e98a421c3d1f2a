//! Readings that share an error: the transform after which their errors are independent again.
//!
//! Every column and every residual, already divided by the standard deviation of what a reading has for itself, is
//! multiplied by the inverse square root of its covariance. Both kinds need no matrix:
//!
//! ```text
//! shared by a record    I + u u'        ->  x - c u (u'x) / u'u,   c = 1 - 1 / sqrt(1 + u'u)
//! drift along the file  phi^|i - j|     ->  (x_i - phi^d x_j) / sqrt(1 - phi^2d),   j the reading before, d rows earlier
//! ```
//!
//! `u`: standard deviation of the shared part over that of the own part. The first is Woodbury's identity, the second the
//! Cholesky factor of a process of first order.

use hexbench_core::Vector6;
use nalgebra::{DMatrix, DVector};

use crate::campaign::Group;
use crate::noise::{Noise, Structure};

/// The transform of a list of conditions.
#[derive(Debug, Clone)]
pub enum Whitening {
    /// Errors are independent.
    Identity,
    /// Conditions of one record share an error in every coordinate.
    Shared {
        /// Record of every condition.
        records: Vec<usize>,
        /// `u` of every condition.
        shares: Vec<Vector6>,
    },
    /// Errors of neighboring rows resemble each other.
    Drift {
        /// Line of every condition in the file, ascending.
        rows: Vec<usize>,
        /// Correlation of neighbors.
        correlation: f64,
    },
}

impl Whitening {
    /// The transform for groups of readings under a noise model.
    pub fn of(groups: &[Group], noise: &Noise) -> Self {
        match noise.structure {
            Structure::Independent | Structure::Setup { .. } => Self::Identity,
            Structure::Reference { .. } => Self::Shared {
                records: groups.iter().map(|g| g.record).collect(),
                shares: groups.iter().map(share).collect(),
            },
            Structure::Drift { correlation } => {
                let rows = groups.iter().map(|g| usize::try_from(g.mean.line).unwrap_or(0)).collect();
                Self::Drift { rows, correlation }
            }
        }
    }

    /// That of some of the conditions, in this order.
    #[must_use]
    pub fn choose(&self, which: impl Iterator<Item = usize>) -> Self {
        match self {
            Self::Identity => Self::Identity,
            Self::Shared { records, shares } => {
                let (records, shares) = which.map(|i| (records[i], shares[i])).unzip();
                Self::Shared { records, shares }
            }
            Self::Drift { rows, correlation } => {
                Self::Drift { rows: which.map(|i| rows[i]).collect(), correlation: *correlation }
            }
        }
    }

    /// True when conditions may be treated one by one.
    pub fn is_identity(&self) -> bool {
        matches!(self, Self::Identity)
    }

    /// Transforms columns with six rows per condition.
    pub fn apply(&self, columns: &mut DMatrix<f64>) {
        if self.is_identity() {
            return;
        }
        for mut column in columns.column_iter_mut() {
            let mut x: DVector<f64> = column.clone_owned();
            self.apply_to(&mut x);
            column.copy_from(&x);
        }
    }

    /// Transforms one column.
    pub fn apply_to(&self, x: &mut DVector<f64>) {
        match self {
            Self::Identity => {}
            Self::Shared { records, shares } => shared(records, shares, x),
            Self::Drift { rows, correlation } => drift(rows, *correlation, x),
        }
    }
}

fn share(group: &Group) -> Vector6 {
    Vector6::from_fn(|k, _| group.shared[k] / group.sigma[k])
}

fn shared(records: &[usize], shares: &[Vector6], x: &mut DVector<f64>) {
    let count = records.iter().max().map_or(0, |last| last + 1);
    let (mut along, mut length) = (vec![Vector6::zeros(); count], vec![Vector6::zeros(); count]);
    for (i, (&record, u)) in records.iter().zip(shares).enumerate() {
        along[record] += u.component_mul(&x.fixed_rows::<6>(6 * i));
        length[record] += u.component_mul(u);
    }
    let factor =
        |square: f64| if square > 0.0 { (1.0 - (1.0 + square).sqrt().recip()) / square } else { 0.0 };
    for (i, (&record, u)) in records.iter().zip(shares).enumerate() {
        let taken = length[record].map(factor).component_mul(&along[record]).component_mul(u);
        let mut part = x.fixed_rows_mut::<6>(6 * i);
        part -= taken;
    }
}

fn drift(rows: &[usize], correlation: f64, x: &mut DVector<f64>) {
    for i in (1..rows.len()).rev() {
        let distance = i32::try_from(rows[i].abs_diff(rows[i - 1])).unwrap_or(i32::MAX);
        let kept = correlation.powi(distance);
        let before = x.fixed_rows::<6>(6 * (i - 1)).into_owned();
        let mut part = x.fixed_rows_mut::<6>(6 * i);
        part -= kept * before;
        part /= (1.0 - kept * kept).sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of sums of a dozen numbers.
    const ROUNDING: f64 = 1e-12;

    /// The transform as a matrix.
    fn matrix(whitening: &Whitening, conditions: usize) -> DMatrix<f64> {
        let mut all = DMatrix::identity(6 * conditions, 6 * conditions);
        whitening.apply(&mut all);
        all
    }

    #[test]
    fn readings_of_one_record_become_independent() {
        let shares = vec![Vector6::repeat(0.8), Vector6::repeat(1.3), Vector6::repeat(0.5)];
        let records = vec![0, 1, 0];
        let mut covariance = DMatrix::<f64>::identity(18, 18);
        for (i, j) in [(0, 0), (0, 2), (2, 0), (2, 2), (1, 1)] {
            for k in 0..6 {
                covariance[(6 * i + k, 6 * j + k)] += shares[i][k] * shares[j][k];
            }
        }
        let w = matrix(&Whitening::Shared { records, shares }, 3);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(18, 18)).amax() < ROUNDING);
    }

    #[test]
    fn neighbors_of_a_drift_become_independent_also_across_a_gap() {
        let rows = vec![0, 1, 4];
        let covariance = DMatrix::from_fn(18, 18, |a, b| {
            if a % 6 == b % 6 { 0.7_f64.powi((rows[a / 6] as i32 - rows[b / 6] as i32).abs()) } else { 0.0 }
        });
        let w = matrix(&Whitening::Drift { rows, correlation: 0.7 }, 3);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(18, 18)).amax() < ROUNDING);
    }
}
