//! F of columns added beside a floating mean, from inner products.
//!
//! With what the fit absorbs in an orthonormal basis `B`, the whitening `W W = I - T T'` where errors of readings are independent, readings
//! `H` of leg elongations and whitened residuals `y`, two elongations `x` and `x'` have the inner products
//!
//! ```text
//! x' (H'H) x'' - (A' H x)' (A' H x''),   A = [W B, T]
//! x' H' W (I - B B') y
//! ```

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::JudgedModel;
use crate::estimation::basis::project;
use crate::inference::elongations::fixed_columns;

/// A column of whose square less than this share is left was absorbed by the fit, or by the others.
const ABSORBED: f64 = 1e-11;

/// What the model leaves of the readings.
pub(super) struct Unexplained {
    /// Square of the residuals.
    square: f64,
    /// Numbers less the rank of the fit.
    freedom: f64,
}

impl Unexplained {
    /// With `[W B, T, W (I - B B') y]`, six rows per condition; none where errors of readings are correlated.
    pub(super) fn of(judged: &JudgedModel<'_>) -> Option<(Self, DMatrix<f64>)> {
        let mut left = judged.white.clone();
        project(&judged.basis, &mut left);
        let fixed = fixed_columns(&judged.lin, &judged.basis, &left)?;
        let freedom = judged.white.len() as f64 - judged.rank;
        Some((Self { square: judged.white.norm_squared(), freedom }, fixed))
    }

    /// F of two elongations beside a floating one, and its chance: from the squares of the three before anything is absorbed, and from
    /// what they are along the fixed columns, the residuals last. An elongation of zeros adds nothing.
    pub(super) fn f_of(&self, own: &Matrix3<f64>, along: &[DVector<f64>; 3]) -> Option<(f64, f64)> {
        let last = along[0].len() - 1;
        let absorbed = |i: usize, j: usize| along[i].rows(0, last).dot(&along[j].rows(0, last));
        let mut gram = Matrix3::from_fn(|i, j| own[(i, j)] - absorbed(i, j));
        let mut with = Vector3::from_fn(|i, _| along[i][last]);
        let (mut before, mut explained, mut taken) = (self.square, 0.0, [false; 3]);
        for i in 0..3 {
            if gram[(i, i)] <= ABSORBED * own[(i, i)] {
                continue;
            }
            taken[i] = true;
            let share = with[i] * with[i] / gram[(i, i)];
            if i == 0 {
                before -= share;
            } else {
                explained += share;
            }
            let column = gram.column(i) / gram[(i, i)];
            with -= column * with[i];
            gram -= column * gram.row(i);
        }
        let gained = f64::from(u8::from(taken[1])) + f64::from(u8::from(taken[2]));
        let dof = self.freedom - gained - f64::from(u8::from(taken[0]));
        let after = before - explained;
        if gained < 1.0 || dof < 3.0 || after <= 0.0 {
            return None;
        }
        let f = explained / gained / (after / dof);
        f.is_finite().then(|| (f, chance(f, gained, dof)))
    }
}

/// Chance of an F this large; with two columns the law has a closed form.
fn chance(f: f64, gained: f64, dof: f64) -> f64 {
    if gained > 1.5 {
        return (-0.5 * dof * (2.0 * f / dof).ln_1p()).exp();
    }
    FisherSnedecor::new(gained, dof).map_or(1.0, |law| law.sf(f))
}
