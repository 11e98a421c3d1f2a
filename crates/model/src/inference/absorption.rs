//! What leg springs (and, in absolute mode, frames) make of a signature they do not stand for.
//!
//! With `C` the whitened columns of springs and frames, a whitened signature `t` splits into a part in the span of `C`, which
//! is absorbed (springs and frames shift by `C^+ t`), and a rest that stays visible.

use std::sync::OnceLock;

use nalgebra::{DMatrix, DVector, Vector6};

use crate::estimation::basis::{orthonormal, project};
use crate::estimation::linearization::Linearization;
use crate::estimation::reduced::Reduced;

/// Rests below this share of the signature are rounding.
const ROUNDING: f64 = 1e-8;

/// What springs and frames absorb at one point of linearization.
#[derive(Debug, Clone)]
pub struct Absorption {
    span: DMatrix<f64>,
    basis: DMatrix<f64>,
    /// The span for many signatures; none where it has no numbers.
    reduced: OnceLock<Option<Reduced>>,
}

impl Absorption {
    /// By the common columns of a linearized campaign.
    pub fn of(lin: &Linearization) -> Self {
        let span = lin.common_block();
        let basis = orthonormal(span.clone());
        Self { span, basis, reduced: OnceLock::new() }
    }

    /// What stays of a whitened signature; zero where only rounding would stay.
    pub fn rest(&self, signature: &DVector<f64>) -> DVector<f64> {
        let mut rest = signature.clone();
        project(&self.basis, &mut rest);
        if rest.norm() < ROUNDING * signature.norm() { DVector::zeros(rest.len()) } else { rest }
    }

    /// Share of the sum of squares of a signature that is absorbed, 0 to 1.
    pub fn share(&self, signature: &DVector<f64>) -> f64 {
        let whole = signature.norm_squared();
        if whole > 0.0 { 1.0 - self.rest(signature).norm_squared() / whole } else { 0.0 }
    }

    /// Shift of the compliances of the legs (m/N), then of the frames, by a signature that is left out; `None` where it
    /// cannot be computed.
    pub fn shift(&self, signature: &DVector<f64>) -> Option<DVector<f64>> {
        let reduced = self.reduced.get_or_init(|| Reduced::of(&self.span).ok());
        Some(reduced.as_ref()?.refined(&self.span, signature).ok()?.x)
    }
}

/// Change of the stiffness of each leg (percent) by a shift of its compliance, both m/N.
pub fn bias_percent(compliance: &Vector6<f64>, shift: &DVector<f64>) -> [f64; 6] {
    std::array::from_fn(|leg| -100.0 * shift[leg] / (compliance[leg] + shift[leg]))
}
