//! A Gaussian expectation of all readings of a menu, renewed each time one of them is chosen.
//!
//! With rows `J` of the menu, covariance `C` of the parameters and unit noise, the innovation of reading `s` given those
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
        Addition {
            log_det: 2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>(),
            square: d.dot(&factor.solve(d)),
        }
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
