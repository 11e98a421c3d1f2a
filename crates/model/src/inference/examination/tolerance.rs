//! Inputs whose errors show in the readings.
//!
//! A hexapod is built and loaded to tolerances, which every fit knows. Where errors of joints or loads show, within their
//! tolerances or beyond, that is told: with a Gaussian for the errors, the evidence for them over exact inputs follows from the
//! same columns, beside the springs and the effects found.

use nalgebra::{DMatrix, DVector};

use super::remainder::{Remainder, explained};
use crate::estimation::linearization::beside;
use crate::estimation::tolerances::InputKind;
use crate::inference::candidates::{orthonormal, project, target};
use crate::inference::evidence::log_sum;

/// Multiples of the stated tolerance that are tried.
const FACTORS: [f64; 5] = [1.0, 2.0, 4.0, 10.0, 25.0];
/// Inputs whose errors are told. The catalogue has terms for the direction and the point of the loads.
const DOUBTED: [InputKind; 2] = [InputKind::Joints, InputKind::LoadGain];

/// Inputs with errors, as the readings tell of them.
pub(super) struct Tolerance {
    /// Which.
    pub(super) kind: InputKind,
    /// Standard deviation of one of them, SI.
    pub(super) size: f64,
    /// Evidence over these inputs being exact, nats.
    pub(super) evidence: f64,
    /// Most probable errors, SI.
    pub(super) errors: Vec<f64>,
}

/// What the readings tell of the inputs; none for absolute poses, where the joints are an effect of the catalogue.
pub(super) fn inexact_inputs(rest: &Remainder<'_>) -> Option<Tolerance> {
    if rest.campaign.is_absolute() {
        return None;
    }
    let basis = orthonormal(&beside(&explained(&rest.lin, rest.point)));
    let mut y = target(&rest.lin, rest.point);
    project(&basis, &mut y);
    let overlap = basis.tr_mul(&rest.inputs);
    let normal = rest.inputs.tr_mul(&rest.inputs) - overlap.tr_mul(&overlap);
    let right: DVector<f64> = rest.inputs.tr_mul(&y);
    let scaled = |kind: InputKind, factor: f64| {
        let mut scales = DVector::repeat(rest.inputs.ncols(), 1.0);
        scales.rows_range_mut(kind.columns()).fill(factor);
        scales
    };
    let at = |kind: InputKind| {
        let (exact, _) = evidence(&normal, &right, &scaled(kind, 0.0))?;
        let tried: Vec<(f64, f64, DVector<f64>)> = FACTORS
            .iter()
            .filter_map(|&factor| {
                let (inexact, errors) = evidence(&normal, &right, &scaled(kind, factor))?;
                Some((inexact - exact, factor, errors))
            })
            .collect();
        // Every width is as probable as any other, before the readings.
        let mean = log_sum(tried.iter().map(|t| t.0)) - (tried.len() as f64).ln();
        let (_, factor, errors) = tried.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((kind, factor, mean - (DOUBTED.len() as f64).ln(), errors))
    };
    let (kind, factor, evidence, errors) =
        DOUBTED.iter().filter_map(|&kind| at(kind)).max_by(|a, b| a.2.total_cmp(&b.2))?;
    let unit = kind.standard_deviation(&rest.campaign.hexapod.tolerances);
    let errors = errors.rows_range(kind.columns()).iter().map(|e| e * unit * factor).collect();
    Some(Tolerance { kind, size: unit * factor, evidence, errors })
}

/// Logarithm of the evidence for errors with these standard deviations over none, and the most probable ones in units of them.
fn evidence(
    normal: &DMatrix<f64>,
    right: &DVector<f64>,
    scales: &DVector<f64>,
) -> Option<(f64, DVector<f64>)> {
    let n = scales.len();
    let scaled = DMatrix::from_fn(n, n, |i, j| {
        scales[i] * normal[(i, j)] * scales[j] + if i == j { 1.0 } else { 0.0 }
    });
    let right = right.component_mul(scales);
    let factor = scaled.cholesky()?;
    let errors = factor.solve(&right);
    let half_log_det: f64 = factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum();
    Some((0.5 * right.dot(&errors) - half_log_det, errors))
}
