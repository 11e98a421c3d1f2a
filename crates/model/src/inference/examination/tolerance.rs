//! Inputs whose errors show in the readings.
//!
//! A hexapod is built and loaded to tolerances, which every fit knows. Where errors of joints or loads show, within their
//! tolerances or beyond, that is told: with a Gaussian for the errors, the evidence for them over exact inputs follows from the
//! same columns, beside the springs and the effects found.

use std::ops::Range;

use hexbench_core::{SensorInput, Tolerances};
use nalgebra::{DMatrix, DVector};

use super::remainder::{Remainder, explained};
use crate::estimation::basis::{orthonormal, project, take_off};
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::beside;
use crate::estimation::parallel::products;
use crate::estimation::tolerances::{InputKind, columns_of_sensors};
use crate::inference::candidates::target;
use crate::inference::evidence::log_sum;

/// Multiples of the stated tolerance that are tried.
const FACTORS: [f64; 5] = [1.0, 2.0, 4.0, 10.0, 25.0];
/// Inputs whose errors are told.
const DOUBTED: [InputKind; 4] =
    [InputKind::Joints, InputKind::LoadGain, InputKind::LoadDirection, InputKind::LoadPoint];

/// Multiples of the tolerance by which a sensor may be worse than others.
const LOOSE: [f64; 4] = [4.0, 10.0, 25.0, 60.0];

/// Inputs that share a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Doubted {
    /// Joints or loads.
    Inputs(InputKind),
    /// The scale of one component of the loads.
    Gain(usize),
    /// One scale of all moments: a lever arm, the unit of its length.
    Moments,
    /// What is known of a sensor.
    Sensor(usize, SensorInput),
}

/// Inputs with errors, as the readings tell of them.
#[derive(Clone)]
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

/// What the readings tell of the inputs, the most evident errors first.
pub(super) fn inexact_inputs(rest: &Remainder<'_>) -> Vec<Tolerance> {
    let Some(known) = WithinTolerances::beside(rest, &explained(rest.lin, rest.point)) else {
        return Vec::new();
    };
    let all = doubted(rest);
    let tried = count_of(all.iter().map(|(doubted, _)| *doubted));
    let at = |(doubted, columns): &(Doubted, Range<usize>)| {
        // A sensor is set up to its tolerance; joints and loads are exact where they are not told of.
        let usual = if doubted.is_of_sensor() { 1.0 } else { 0.0 };
        let own = known.doubting(*doubted, columns)?;
        let (before, _) = own.evidence(usual)?;
        let Widest { evidence, factor, errors } = own.widest(doubted.factors())?;
        let evidence = evidence - before - tried.ln() - doubted.rarity();
        Some(rest.told(*doubted, factor, evidence, &errors))
    };
    let mut found: Vec<Tolerance> = all.iter().filter_map(at).collect();
    found.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    found
}

impl Remainder<'_> {
    /// Inputs that are looser than stated by a factor. `errors`: of these inputs, in units of their standard deviations.
    pub(super) fn told(
        &self,
        doubted: Doubted,
        factor: f64,
        evidence: f64,
        errors: &DVector<f64>,
    ) -> Tolerance {
        let size = factor * doubted.standard_deviation(&self.campaign.hexapod.tolerances);
        Tolerance { doubted, factor, size, evidence, errors: errors.iter().map(|e| e * size).collect() }
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
    all.extend(gains_doubted());
    all.extend(sensors_doubted(rest));
    all
}

/// Scales of one component of the loads, and of all moments together, with their columns.
pub(super) fn gains_doubted() -> impl Iterator<Item = (Doubted, Range<usize>)> {
    let all = InputKind::LoadGain.columns();
    let moments = (Doubted::Moments, all.start + 3..all.end);
    all.enumerate().map(|(k, column)| (Doubted::Gain(k), column..column + 1)).chain([moments])
}

/// What is known of sensors, with its columns.
pub(super) fn sensors_doubted(rest: &Remainder<'_>) -> Vec<(Doubted, Range<usize>)> {
    if rest.campaign.reads_poses {
        return Vec::new();
    }
    let all = columns_of_sensors(&rest.campaign.hexapod.sensors).into_iter();
    all.map(|(index, input, columns)| (Doubted::Sensor(index, input), columns)).collect()
}

/// How many kinds of errors are asked for: a scale of a part of the loads is a case of the scales of all of them.
pub(super) fn count_of(all: impl Iterator<Item = Doubted>) -> f64 {
    all.filter(|doubted| doubted.rarity() <= 0.0).count() as f64
}

impl Doubted {
    /// What it costs to ask for a case of another kind of errors, nats.
    pub(super) fn rarity(self) -> f64 {
        match self {
            Self::Gain(_) => 6.0_f64.ln(),
            Self::Moments => 2.0_f64.ln(),
            Self::Inputs(_) | Self::Sensor(..) => 0.0,
        }
    }

    /// True for what is known of a sensor.
    pub(super) fn is_of_sensor(self) -> bool {
        matches!(self, Self::Sensor(..))
    }

    /// Multiples of its tolerance that are tried. The catalogue has terms for loads that are off by more than their tolerance, but
    /// not for a component of the load cell.
    pub(super) fn factors(self) -> &'static [f64] {
        match self {
            Self::Inputs(InputKind::LoadDirection | InputKind::LoadPoint) => &FACTORS[..1],
            Self::Inputs(_) | Self::Gain(_) | Self::Moments => &FACTORS,
            Self::Sensor(..) => &LOOSE,
        }
    }

    /// Standard deviation of one of them, SI.
    fn standard_deviation(self, tolerances: &Tolerances) -> f64 {
        match self {
            Self::Inputs(kind) => kind.standard_deviation(tolerances),
            Self::Gain(_) | Self::Moments => tolerances.load_gain,
            Self::Sensor(_, input) => input.standard_deviation(tolerances),
        }
    }
}

/// Inputs that are known within their tolerances, beside other columns of any size.
pub(super) struct WithinTolerances<'a> {
    inputs: &'a DMatrix<f64>,
    /// Orthonormal basis of the other columns.
    basis: DMatrix<f64>,
    /// What they leave of the readings.
    left: DVector<f64>,
    /// Inverse of the normal equations with the prior of every input.
    covariance: DMatrix<f64>,
    /// Most probable errors.
    mean: DVector<f64>,
}

/// Normal equations of some columns, the errors of all others integrated out.
pub(super) struct Reduced {
    normal: DMatrix<f64>,
    right: DVector<f64>,
}

/// Mean evidence over some widths of a prior, and the likeliest of them.
pub(super) struct Widest {
    pub(super) evidence: f64,
    pub(super) factor: f64,
    /// Most probable errors at that width, in units of it.
    pub(super) errors: DVector<f64>,
}

impl<'a> WithinTolerances<'a> {
    /// The inputs of readings, beside some columns.
    pub(super) fn beside(rest: &Remainder<'a>, columns: &[DMatrix<f64>]) -> Option<Self> {
        Self::new(rest.inputs, orthonormal(beside(columns)), target(rest.lin, rest.point))
    }

    fn new(inputs: &'a DMatrix<f64>, basis: DMatrix<f64>, mut left: DVector<f64>) -> Option<Self> {
        project(&basis, &mut left);
        let overlap = products(&basis, inputs);
        let n = inputs.ncols();
        let normal = products(inputs, inputs) - overlap.tr_mul(&overlap) + DMatrix::identity(n, n);
        let factor = normal.cholesky()?;
        let mean = factor.solve(&inputs.tr_mul(&left));
        Some(Self { inputs, basis, left, covariance: factor.inverse(), mean })
    }

    /// Normal equations of columns more.
    pub(super) fn and(&self, mut columns: DMatrix<f64>) -> Reduced {
        take_off(&self.basis, &mut columns);
        let across = products(self.inputs, &columns);
        Reduced {
            normal: products(&columns, &columns) - across.tr_mul(&(&self.covariance * &across)),
            right: columns.tr_mul(&self.left) - across.tr_mul(&self.mean),
        }
    }

    /// Normal equations of inputs that are doubted, for a width over their tolerance; of a scale of all moments, beside those of each.
    pub(super) fn doubting(&self, doubted: Doubted, columns: &Range<usize>) -> Option<Reduced> {
        match doubted {
            Doubted::Moments => {
                let together = self.inputs.columns_range(columns.clone()).column_sum();
                Some(self.and(DMatrix::from_column_slice(together.len(), 1, together.as_slice())))
            }
            _ => self.of(columns),
        }
    }

    /// Those of some columns. With `P` their block of the covariance and `u` their most probable errors, `P^-1 - 1` and `P^-1 u`.
    pub(super) fn of(&self, columns: &Range<usize>) -> Option<Reduced> {
        let n = columns.len();
        let own = self.covariance.view((columns.start, columns.start), (n, n)).clone_owned().cholesky()?;
        let right = own.solve(&self.mean.rows_range(columns.clone()));
        Some(Reduced { normal: own.inverse() - DMatrix::identity(n, n), right })
    }
}

impl Reduced {
    /// Logarithm of the likelihood of some of its columns, as they are, over none.
    pub(super) fn gain(&self, columns: &[usize]) -> f64 {
        let of = |&i: &usize| {
            let beside: f64 = columns.iter().map(|&j| self.normal[(i, j)]).sum();
            self.right[i] - 0.5 * beside
        };
        columns.iter().map(of).sum()
    }

    /// Expected length of what standard deviations of one in every column do to the readings.
    pub(super) fn signature(&self) -> f64 {
        self.normal.trace().max(0.0).sqrt()
    }

    /// Logarithm of the evidence for errors with this standard deviation over none, and the most probable ones in units of it.
    pub(super) fn evidence(&self, scale: f64) -> Option<(f64, DVector<f64>)> {
        let n = self.right.len();
        let factor = (&self.normal * (scale * scale) + DMatrix::identity(n, n)).cholesky()?;
        let right = &self.right * scale;
        let errors = factor.solve(&right);
        let half_log_det = 0.5 * factor.ln_determinant();
        Some((0.5 * right.dot(&errors) - half_log_det, errors))
    }

    /// Of widths of which every one is as probable as any other, before the readings.
    pub(super) fn widest(&self, factors: &[f64]) -> Option<Widest> {
        let at = |&factor: &f64| {
            let (evidence, errors) = self.evidence(factor)?;
            Some(Widest { evidence, factor, errors })
        };
        let tried: Vec<Widest> = factors.iter().filter_map(at).collect();
        let mean = log_sum(tried.iter().map(|t| t.evidence)) - (tried.len() as f64).ln();
        let best = tried.into_iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
        Some(Widest { evidence: mean, ..best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_columns_alone_give_the_evidence_of_all_of_them_together() {
        let columns = DMatrix::from_fn(12, 5, |i, j| {
            ((3 * i + 7 * j + i * j) % 11) as f64 / 4.0 - 1.0 + 0.1 * j as f64
        });
        let y = DVector::from_fn(12, |i, _| (i as f64).sin() * 3.0);
        let known = WithinTolerances::new(&columns, DMatrix::zeros(12, 0), y.clone()).unwrap();
        // Everything at once, by the covariance of the readings.
        let whole = |scales: [f64; 5]| {
            let scaled = &columns * DMatrix::from_diagonal(&DVector::from_row_slice(&scales));
            let covariance = &scaled * scaled.transpose() + DMatrix::identity(12, 12);
            let factor = covariance.cholesky().unwrap();
            let half_log_det = 0.5 * factor.ln_determinant();
            -0.5 * y.dot(&factor.solve(&y)) - half_log_det
        };
        let own = known.of(&(1..3)).unwrap();
        let told = |scale| own.evidence(scale).unwrap().0;
        for (scale, scales) in [(0.0, [1.0, 0.0, 0.0, 1.0, 1.0]), (6.0, [1.0, 6.0, 6.0, 1.0, 1.0])] {
            let wanted = whole(scales) - whole([1.0; 5]);
            assert!((told(scale) - told(1.0) - wanted).abs() < 1e-10, "{scale}");
        }
        // Columns that are no inputs, of which the others are.
        let inputs = columns.columns_range(1..).into_owned();
        let known = WithinTolerances::new(&inputs, DMatrix::zeros(12, 0), y.clone()).unwrap();
        let more = known.and(columns.columns_range(..1).into_owned());
        let wanted = whole([6.0, 1.0, 1.0, 1.0, 1.0]) - whole([0.0, 1.0, 1.0, 1.0, 1.0]);
        assert!((more.evidence(6.0).unwrap().0 - wanted).abs() < 1e-10);
    }
}
