//! What makes the six numbers of a reading independent, with a variance of one.

use std::sync::Arc;

use hexbench_core::{Matrix6, Vector6};
use nalgebra::SMatrix;

/// `w = L^-1 S^-1 y`: numbers `y` over their standard deviations `S`, freed of the correlation `L L'` that they have with each other.
#[derive(Debug, Clone)]
pub struct ReadingWeights {
    /// `1 / S`.
    weight: Vector6,
    /// `L^-1`; none where the numbers err independently.
    freed: Option<Arc<Matrix6>>,
}

impl ReadingWeights {
    /// Of numbers as they are.
    pub(crate) fn one() -> Self {
        Self { weight: Vector6::repeat(1.0), freed: None }
    }

    pub(crate) fn new(sigma: &[f64; 6], freed: Option<Arc<Matrix6>>) -> Self {
        Self { weight: Vector6::from_fn(|k, _| 1.0 / sigma[k]), freed }
    }

    /// Numbers, weighted; columns of them likewise.
    pub fn of<const N: usize>(&self, mut numbers: SMatrix<f64, 6, N>) -> SMatrix<f64, 6, N> {
        for (k, weight) in self.weight.iter().enumerate() {
            numbers.row_mut(k).scale_mut(*weight);
        }
        self.freed.as_deref().map_or(numbers, |freed| freed * numbers)
    }

    /// The numbers of which these are the weighted ones.
    pub fn numbers<const N: usize>(&self, weighted: SMatrix<f64, 6, N>) -> SMatrix<f64, 6, N> {
        let correlated = self.freed.as_deref().and_then(|freed| freed.solve_lower_triangular(&weighted));
        let mut numbers = correlated.unwrap_or(weighted);
        for (k, weight) in self.weight.iter().enumerate() {
            numbers.row_mut(k).scale_mut(weight.recip());
        }
        numbers
    }
}

/// `L^-1` of a covariance `L L'`; none where it has no inverse.
pub(crate) fn freed_of(covariance: &Matrix6) -> Option<Arc<Matrix6>> {
    covariance.cholesky().and_then(|factor| factor.l().try_inverse()).map(Arc::new)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;

    #[test]
    fn numbers_that_err_together_become_independent_and_come_back() {
        let root = Matrix6::from_fn(|i, j| ((3 * i + 5 * j) % 7) as f64 * 0.2 + f64::from(u8::from(i == j)));
        let sigma = [1e-6, 2e-6, 3e-6, 1e-5, 2e-5, 3e-5];
        let weights = ReadingWeights::new(&sigma, freed_of(&(root * root.transpose())));
        let covariance = {
            let scaled = Matrix6::from_diagonal(&Vector6::from(sigma)) * root;
            scaled * scaled.transpose()
        };
        let white = weights.of(weights.of(covariance).transpose());
        assert!((white - Matrix6::identity()).amax() < 1e-9, "{white}");
        let numbers = Vector6::from_fn(|k, _| sigma[k] * (k as f64 - 2.5));
        assert!((weights.numbers(weights.of(numbers)) - numbers).amax() < 1e-17);
    }
}
