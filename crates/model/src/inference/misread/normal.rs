//! Springs of a file by least squares, none of them negative.

use std::ops::{Add, Sub};

use hexbench_core::{Matrix6, Vector6};

/// A compliance this many standard deviations below zero is no spring.
const NEGATIVE_SIGMAS: f64 = 3.0;

/// Normal equations of the springs.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Normal {
    n: Matrix6,
    right: Vector6,
    square: f64,
    /// Sum of the logarithms of the weights over those of the file as written.
    pub(super) density: f64,
}

impl Normal {
    /// Of all rows.
    pub(super) fn of(rows: &[Whitened]) -> Self {
        let mut normal = Self::default();
        for row in rows {
            normal.push(row);
        }
        normal
    }

    pub(super) fn push(&mut self, row: &Whitened) {
        self.n += row.columns.tr_mul(&row.columns);
        self.right += row.columns.tr_mul(&row.read);
        self.square += row.read.norm_squared();
        self.density += row.density;
    }
}

impl Add for Normal {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            n: self.n + other.n,
            right: self.right + other.right,
            square: self.square + other.square,
            density: self.density + other.density,
        }
    }
}

impl Sub for Normal {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            n: self.n - other.n,
            right: self.right - other.right,
            square: self.square - other.square,
            density: self.density - other.density,
        }
    }
}

/// Columns of the springs and readings of a condition, over the noise.
pub(super) struct Whitened {
    pub(super) columns: Matrix6,
    pub(super) read: Vector6,
    pub(super) density: f64,
}

/// Least squares with compliances that are not negative: a leg that would have one is held at zero. Compliances, chi-square and
/// the number of such legs.
pub(super) fn non_negative(normal: &Normal, freedom: f64) -> Option<(Vector6, f64, usize)> {
    let mut held = [false; 6];
    loop {
        let mut n = normal.n;
        let mut right = normal.right;
        let scale = normal.n.diagonal().amax();
        for leg in (0..6).filter(|&l| held[l] || normal.n[(l, l)] <= 1e-18 * scale) {
            n.row_mut(leg).fill(0.0);
            n.column_mut(leg).fill(0.0);
            n[(leg, leg)] = 1.0;
            right[leg] = 0.0;
        }
        // Columns of springs may differ by orders of magnitude.
        let size = n.diagonal().map(f64::sqrt);
        let scaled = Matrix6::from_fn(|i, j| n[(i, j)] / (size[i] * size[j]));
        let factor = (scaled + Matrix6::identity() * 1e-12).cholesky()?;
        let solution = factor.solve(&right.component_div(&size)).component_div(&size);
        let chi2 = (normal.square - solution.dot(&right)).max(0.0);
        let inverse = factor.inverse();
        let level = (chi2 / freedom).max(1.0).sqrt();
        let sigmas = |leg: usize| solution[leg] * size[leg] / (inverse[(leg, leg)].sqrt() * level);
        let worst = (0..6).filter(|&l| !held[l]).min_by(|&a, &b| sigmas(a).total_cmp(&sigmas(b)));
        match worst {
            Some(leg) if sigmas(leg) < -NEGATIVE_SIGMAS => held[leg] = true,
            _ => return Some((solution, chi2, held.iter().filter(|h| **h).count())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leg_is_held_at_zero_where_its_compliance_is_three_standard_deviations_below() {
        for (sigmas, held, spring, left) in [(2.9, 0, -0.29, 0.0), (3.1, 1, 0.0, 9.61)] {
            let mut read = Vector6::repeat(5.0);
            read[2] = -sigmas;
            let mut normal = Normal::default();
            normal.push(&Whitened { columns: Matrix6::identity() * 10.0, read, density: 0.0 });
            let (springs, chi2, negative) = non_negative(&normal, 6.0).unwrap();
            assert_eq!(negative, held);
            assert!((springs[2] - spring).abs() < 1e-9 && (chi2 - left).abs() < 1e-9, "{springs} {chi2}");
        }
    }
}
