//! Readings that share an error: the transform after which their errors are independent again.
//!
//! Every column and every residual, already divided by the standard deviation of what a reading has for itself, is
//! multiplied by the inverse square root of its covariance. Both kinds need no matrix:
//!
//! ```text
//! shared by a record    I + u u'        ->  x - c u (u'x) / u'u,   c = 1 - 1 / sqrt(1 + u'u)
//! drift along the file  I + u_i u_j phi^|i - j|  ->  innovations of the Kalman filter over their standard deviations
//! ```
//!
//! `u`: standard deviation of the shared part over that of the own part. The first is Woodbury's identity, the second the
//! Cholesky factor of white noise beside a process of first order.

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
        /// `u` of every condition.
        shares: Vec<Vector6>,
        /// Correlation of neighboring lines.
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
            Structure::Drift { correlation, .. } => Self::Drift {
                rows: groups.iter().map(|g| usize::try_from(g.mean.line).unwrap_or(0)).collect(),
                shares: groups.iter().map(share).collect(),
                correlation,
            },
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
            Self::Drift { rows, shares, correlation } => {
                let (rows, shares) = which.map(|i| (rows[i], shares[i])).unzip();
                Self::Drift { rows, shares, correlation: *correlation }
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
            Self::Drift { rows, shares, correlation } => drift(rows, shares, *correlation, x),
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

fn drift(rows: &[usize], shares: &[Vector6], correlation: f64, x: &mut DVector<f64>) {
    for k in 0..6 {
        let mut filter = Filter::default();
        for i in 0..rows.len() {
            let distance = if i == 0 { 0 } else { rows[i].abs_diff(rows[i - 1]) };
            let (innovation, variance) = filter.step(x[6 * i + k], shares[i][k], distance, correlation);
            x[6 * i + k] = innovation / variance.sqrt();
        }
    }
}

/// Kalman filter of a process of first order with unit variance, seen with white noise of unit variance.
pub struct Filter {
    mean: f64,
    variance: f64,
}

impl Default for Filter {
    fn default() -> Self {
        Self { mean: 0.0, variance: 1.0 }
    }
}

impl Filter {
    /// What a reading brings that is new, and the variance of it; `share` of the process is in the reading, `distance` steps after
    /// the one before.
    pub fn step(&mut self, reading: f64, share: f64, distance: usize, correlation: f64) -> (f64, f64) {
        let kept = correlation.powi(i32::try_from(distance).unwrap_or(i32::MAX));
        let mean = kept * self.mean;
        let before = 1.0 + kept * kept * (self.variance - 1.0);
        let innovation = reading - share * mean;
        let variance = 1.0 + share * share * before;
        let gain = before * share / variance;
        self.mean = mean + gain * innovation;
        self.variance = before * (1.0 - gain * share);
        (innovation, variance)
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
        let rows: Vec<usize> = vec![0, 1, 4];
        let shares = vec![Vector6::repeat(0.8), Vector6::repeat(1.3), Vector6::repeat(0.5)];
        let covariance = DMatrix::from_fn(18, 18, |a, b| {
            let (i, j, same) = (a / 6, b / 6, a % 6 == b % 6);
            let distance = i32::try_from(rows[i].abs_diff(rows[j])).unwrap_or(0);
            let drift = shares[i][0] * shares[j][0] * 0.7_f64.powi(distance);
            f64::from(u8::from(a == b)) + if same { drift } else { 0.0 }
        });
        let w = matrix(&Whitening::Drift { rows, shares, correlation: 0.7 }, 3);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(18, 18)).amax() < ROUNDING);
    }
}
