//! Inputs whose errors show in the readings.
//!
//! A hexapod is built and loaded to tolerances, which every fit knows. Where errors of joints or loads show, within their
//! tolerances or beyond, that is told: with a Gaussian for the errors, the evidence for them over exact inputs follows from the
//! same columns, beside the springs and the effects found.

use std::ops::Range;

use hexbench_core::Tolerances;
use nalgebra::{DMatrix, DVector};

use super::remainder::{Remainder, explained};
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::beside;
use crate::estimation::tolerances::{InputKind, columns_of_sensor};
use crate::inference::candidates::target;
use crate::inference::evidence::log_sum;

/// Multiples of the stated tolerance that are tried.
const FACTORS: [f64; 5] = [1.0, 2.0, 4.0, 10.0, 25.0];
/// Inputs whose errors are told. The catalogue has terms for the direction and the point of the loads.
const DOUBTED: [InputKind; 2] = [InputKind::Joints, InputKind::LoadGain];

/// Multiples of the tolerance by which a sensor may stand worse than others.
pub(super) const LOOSE: [f64; 4] = [4.0, 10.0, 25.0, 60.0];

/// Inputs that share a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Doubted {
    /// Joints or loads.
    Inputs(InputKind),
    /// The place of a sensor.
    Place(usize),
    /// The direction of a sensor.
    Direction(usize),
}

/// Inputs with errors, as the readings tell of them.
pub(super) struct Tolerance {
    /// Which.
    pub(super) doubted: Doubted,
    /// Their tolerance over the stated one.
    pub(super) factor: f64,
    /// Standard deviation of one of them, SI.
    pub(super) size: f64,
    /// Evidence over these inputs being exact, nats.
    pub(super) evidence: f64,
    /// Most probable errors, SI.
    pub(super) errors: Vec<f64>,
}

/// What the readings tell of the inputs.
pub(super) fn inexact_inputs(rest: &Remainder<'_>) -> Option<Tolerance> {
    let basis = orthonormal(&beside(&explained(&rest.lin, rest.point)));
    let mut y = target(&rest.lin, rest.point);
    project(&basis, &mut y);
    let overlap = basis.tr_mul(rest.inputs);
    let normal = rest.inputs.tr_mul(rest.inputs) - overlap.tr_mul(&overlap);
    let right: DVector<f64> = rest.inputs.tr_mul(&y);
    let scaled = |columns: &Range<usize>, factor: f64| {
        let mut scales = DVector::repeat(rest.inputs.ncols(), 1.0);
        scales.rows_range_mut(columns.clone()).fill(factor);
        scales
    };
    let all = doubted(rest);
    let at = |(doubted, columns): &(Doubted, Range<usize>)| {
        // A sensor is set up to its tolerance; joints and loads are exact where they are not told of.
        let (usual, factors) =
            if matches!(doubted, Doubted::Inputs(_)) { (0.0, &FACTORS[..]) } else { (1.0, &LOOSE[..]) };
        let (before, _) = evidence(&normal, &right, &scaled(columns, usual))?;
        let tried: Vec<(f64, f64, DVector<f64>)> = factors
            .iter()
            .filter_map(|&factor| {
                let (inexact, errors) = evidence(&normal, &right, &scaled(columns, factor))?;
                Some((inexact - before, factor, errors))
            })
            .collect();
        // Every width is as probable as any other, before the readings.
        let mean = log_sum(tried.iter().map(|t| t.0)) - (tried.len() as f64).ln();
        let (_, factor, errors) = tried.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((*doubted, columns.clone(), factor, mean - (all.len() as f64).ln(), errors))
    };
    let (doubted, columns, factor, evidence, errors) =
        all.iter().filter_map(at).max_by(|a, b| a.3.total_cmp(&b.3))?;
    Some(rest.told(doubted, columns, factor, evidence, &errors))
}

impl Remainder<'_> {
    /// Inputs that are looser than stated by a factor. `errors`: of all inputs, in units of their standard deviations.
    pub(super) fn told(
        &self,
        doubted: Doubted,
        columns: Range<usize>,
        factor: f64,
        evidence: f64,
        errors: &DVector<f64>,
    ) -> Tolerance {
        let unit = doubted.standard_deviation(&self.campaign.hexapod.tolerances);
        let errors = errors.rows_range(columns).iter().map(|e| e * unit * factor).collect();
        Tolerance { doubted, factor, size: unit * factor, evidence, errors }
    }
}

/// Joints of a machine whose poses are absolute are an effect of the catalogue.
fn doubted_kinds(campaign: &Campaign) -> impl Iterator<Item = InputKind> {
    let joints_are_fitted = campaign.is_absolute();
    DOUBTED.into_iter().filter(move |kind| !(joints_are_fitted && *kind == InputKind::Joints))
}

/// Inputs that are doubted, with their columns.
fn doubted(rest: &Remainder<'_>) -> Vec<(Doubted, Range<usize>)> {
    let mut all: Vec<(Doubted, Range<usize>)> =
        doubted_kinds(rest.campaign).map(|kind| (Doubted::Inputs(kind), kind.columns())).collect();
    all.extend(sensors_doubted(rest));
    all
}

/// Places and directions of sensors, with their columns.
pub(super) fn sensors_doubted(rest: &Remainder<'_>) -> Vec<(Doubted, Range<usize>)> {
    let mut all = Vec::new();
    if rest.campaign.reads_poses {
        return all;
    }
    let sensors = &rest.campaign.hexapod.sensors;
    for index in 0..sensors.len() {
        let [place, direction] = columns_of_sensor(sensors, index);
        all.extend(place.map(|columns| (Doubted::Place(index), columns)));
        all.extend(direction.map(|columns| (Doubted::Direction(index), columns)));
    }
    all
}

impl Doubted {
    /// Standard deviation of one of them, SI.
    fn standard_deviation(self, tolerances: &Tolerances) -> f64 {
        match self {
            Self::Inputs(kind) => kind.standard_deviation(tolerances),
            Self::Place(_) => tolerances.sensor_point,
            Self::Direction(_) => tolerances.sensor_direction,
        }
    }
}

/// Logarithm of the evidence for errors with these standard deviations over none, and the most probable ones in units of them.
pub(super) fn evidence(
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
