//! A Gaussian expectation of all candidate readings, renewed each time one of them is chosen.
//!
//! With rows `J` of the candidates, covariance `C` of the parameters and unit noise, the innovation of reading `s` given those
//! chosen has covariance `S_s = I + J_s C J_s'`. Choosing `t` changes `C` to `C - C J_t' S_t^-1 J_t C` (Kalman 1960), so that
//! the log-determinant and the squared length of all chosen readings are sums over the choices.

use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector};

/// What one more reading adds.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Addition {
    /// To the logarithm of the determinant of the covariance.
    pub(super) log_det: f64,
    /// To the squared length of the difference, in units of that covariance.
    pub(super) square: f64,
}

/// See the module.
pub(super) struct Filter {
    rows: DMatrix<f64>,
    covariance: DMatrix<f64>,
    innovation: Vec<Matrix6>,
    difference: Vec<Vector6>,
}

impl Filter {
    /// Rows (six per reading), covariance of the parameters, and a difference whose length is asked for.
    pub(super) fn new(rows: DMatrix<f64>, covariance: DMatrix<f64>, difference: &DVector<f64>) -> Self {
        let spread = &rows * &covariance;
        let n = rows.nrows() / 6;
        let innovation = |i: usize| {
            let product = spread.rows(6 * i, 6) * rows.rows(6 * i, 6).transpose();
            Matrix6::identity() + product.fixed_view::<6, 6>(0, 0)
        };
        Self {
            innovation: (0..n).map(innovation).collect(),
            difference: (0..n).map(|i| difference.fixed_rows::<6>(6 * i).into_owned()).collect(),
            rows,
            covariance,
        }
    }

    /// What choosing a reading would add.
    pub(super) fn addition(&self, reading: usize) -> Addition {
        let Some(factor) = self.innovation[reading].cholesky() else { return Addition::default() };
        let d = &self.difference[reading];
        Addition { log_det: factor.ln_determinant(), square: d.dot(&factor.solve(d)) }
    }

    /// Choose a reading: everything else is expected given its value.
    pub(super) fn choose(&mut self, reading: usize) {
        let Some(factor) = self.innovation[reading].cholesky() else { return };
        let gain = &self.covariance * self.rows.rows(6 * reading, 6).transpose();
        let cross = &self.rows * &gain;
        let known = factor.solve(&self.difference[reading]);
        for (i, (s, d)) in self.innovation.iter_mut().zip(&mut self.difference).enumerate() {
            let c: Matrix6 = cross.fixed_view::<6, 6>(6 * i, 0).into_owned();
            *s -= c * factor.solve(&c.transpose());
            *d -= c * known;
        }
        let solved = factor.inverse();
        let solved = DMatrix::from_column_slice(6, 6, solved.as_slice());
        self.covariance -= &gain * solved * gain.transpose();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::campaign::rows_of;

    /// Rounding of sums over 24 numbers.
    const CLOSE: f64 = 1e-9;

    #[test]
    fn additions_of_a_sequence_make_up_the_determinant_and_length_of_the_whole() {
        const READINGS: usize = 5;
        const PARAMETERS: usize = 4;
        let rows =
            DMatrix::from_fn(6 * READINGS, PARAMETERS, |i, j| (1.7 * i as f64 + 2.3 * (j * j) as f64).sin());
        let root = DMatrix::from_fn(PARAMETERS, PARAMETERS, |i, j| 0.3 + (i as f64 - 0.6 * j as f64).cos());
        let covariance = &root * root.transpose();
        let difference = DVector::from_fn(6 * READINGS, |i, _| (0.9 * i as f64).cos());
        let mut filter = Filter::new(rows.clone(), covariance.clone(), &difference);
        // The same reading may be taken twice.
        let taken = [3, 0, 3, 4];
        let mut total = Addition::default();
        for &reading in &taken {
            let added = filter.addition(reading);
            total.log_det += added.log_det;
            total.square += added.square;
            filter.choose(reading);
        }
        let picked = rows_of(taken.iter().copied());
        let j = rows.select_rows(&picked);
        let whole = DMatrix::identity(24, 24) + &j * covariance * j.transpose();
        let d = difference.select_rows(&picked);
        let factor = whole.cholesky().unwrap();
        let log_det = factor.ln_determinant();
        let square = d.dot(&factor.solve(&d));
        assert!((total.log_det / log_det - 1.0).abs() < CLOSE, "{} {log_det}", total.log_det);
        assert!((total.square / square - 1.0).abs() < CLOSE, "{} {square}", total.square);
    }
}
