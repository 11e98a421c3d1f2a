//! Joints that are not quite where the drawing has them.
//!
//! A hexapod is built to a tolerance. What 36 small errors of its joints do to the readings is linear in them and follows
//! from the model; with a Gaussian of unknown width for the errors, the evidence for them is that of
//! [`evidence`](crate::inference::evidence), beside the springs and the effects found.

use nalgebra::{DMatrix, DVector};

use super::remainder::Remainder;
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, moved};
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::inference::candidates::{orthonormal, project, target};

/// Standard deviations of a joint coordinate that are tried, m.
const SIZES: [f64; 5] = [2e-5, 5e-5, 1e-4, 2e-4, 5e-4];
/// Step of a joint for its derivatives, m.
const STEP: f64 = 1e-5;
/// Joint coordinates: six joints, two ends, three axes.
const COORDINATES: usize = 36;

/// Joints off the drawing, as the readings tell of them.
pub(super) struct Tolerance {
    /// Standard deviation of a joint coordinate, m.
    pub(super) size: f64,
    /// Evidence over joints as drawn, nats.
    pub(super) evidence: f64,
    /// Whitened reading per standard deviation of every coordinate.
    pub(super) columns: DMatrix<f64>,
}

/// What the readings tell of the joints; none for absolute poses, where the joints are an effect of the catalogue.
///
/// # Errors
/// As [`Linearization::at`].
pub(super) fn joints(rest: &Remainder<'_>) -> Result<Option<Tolerance>, ModelError> {
    if rest.campaign.is_absolute() {
        return Ok(None);
    }
    let slopes = slopes(rest)?;
    let mut common = vec![rest.lin.common_block()];
    common.extend(rest.point.active.iter().map(|a| rest.lin.term_block(a.term.as_ref(), a.rich, a.shape)));
    let basis = orthonormal(&beside(&common));
    let mut y = target(&rest.lin, rest.point);
    project(&basis, &mut y);
    let overlap = basis.tr_mul(&slopes);
    let normal = slopes.tr_mul(&slopes) - overlap.tr_mul(&overlap);
    let right: DVector<f64> = slopes.tr_mul(&y);
    let at = |&size: &f64| {
        let scaled = &normal * (size * size) + DMatrix::identity(COORDINATES, COORDINATES);
        let factor = scaled.cholesky()?;
        let half_log_det: f64 = factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum();
        let gain = 0.5 * size * size * right.dot(&factor.solve(&right));
        Some((size, gain - half_log_det - (SIZES.len() as f64).ln()))
    };
    let best = SIZES.iter().filter_map(at).max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(best.map(|(size, evidence)| Tolerance { size, evidence, columns: slopes * size }))
}

/// Whitened reading per meter of every joint coordinate, base joints first.
fn slopes(rest: &Remainder<'_>) -> Result<DMatrix<f64>, ModelError> {
    let mut slopes = DMatrix::zeros(rest.lin.equations(), COORDINATES);
    for k in 0..COORDINATES {
        let (plus, minus) = (residuals(rest, k, STEP)?, residuals(rest, k, -STEP)?);
        // A residual falls as the prediction rises.
        slopes.set_column(k, &((minus - plus) / (2.0 * STEP)));
    }
    Ok(slopes)
}

/// Residuals of a machine with one joint elsewhere; it stands where the commanded lengths put it.
fn residuals(rest: &Remainder<'_>, coordinate: usize, step: f64) -> Result<DVector<f64>, ModelError> {
    let (joint, axis) = (coordinate % 18 / 3, coordinate % 3);
    let mut point: ModelPoint = rest.point.clone();
    let at_base = coordinate < 18;
    let joints = if at_base { &mut point.machine.base_joints } else { &mut point.machine.platform_joints };
    joints[joint][axis] += step;
    let mut campaign: Campaign = rest.campaign.clone();
    for group in &mut campaign.groups {
        let pose = group.mean.pose;
        let (drawn, real) = (rest.point.machine.legs(&pose)?, point.machine.legs(&pose)?);
        let twist = drawn.platform_jacobian * (drawn.lengths - real.lengths);
        group.mean.pose = moved(&pose, &twist, 1.0);
    }
    Ok(Linearization::at(&campaign, &point)?.residuals())
}
