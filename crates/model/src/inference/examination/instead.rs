//! A sensor that stands or looks elsewhere, where an effect is seen.
//!
//! One gauge among three that looks at another point of the platform leaves much the same readings as three gauges whose platform is
//! registered beside its origin, or as a platform that yields. Both explanations are weighed alike, each by its mean evidence over the
//! widths that it may have, beside the springs and the other effects found:
//!
//! ```text
//! ln odds = ln Z(sensor to a wider tolerance, without the effect) - ln Z(sensors as stated, with the effect)
//! ```

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::remainder::Remainder;
use super::tolerance::{Doubted, LOOSE, Tolerance, evidence, sensors_doubted};
use crate::effects::term::Natural;
use crate::estimation::basis::orthonormal;
use crate::estimation::linearization::beside;
use crate::inference::candidates::{sizes, target};
use crate::inference::evidence::{log_sum, widths};

/// The sensor that explains most of what an effect found is taken to explain; its evidence is that over the effect, nats.
pub(super) fn instead_of_effects(rest: &Remainder<'_>, natural: &Natural) -> Option<Tolerance> {
    let sensors = sensors_doubted(rest);
    let effects = if sensors.is_empty() { 0 } else { rest.point.active.len() };
    let all = (0..effects).filter_map(|effect| instead_of(rest, natural, effect, &sensors));
    all.max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

fn instead_of(
    rest: &Remainder<'_>,
    natural: &Natural,
    effect: usize,
    sensors: &[(Doubted, Range<usize>)],
) -> Option<Tolerance> {
    let active = &rest.point.active;
    let block = |k: usize| rest.lin.term_block(active[k].term.as_ref(), active[k].rich, active[k].shape);
    let others = (0..active.len()).filter(|k| *k != effect).map(block);
    let basis =
        orthonormal(&beside(&std::iter::once(rest.lin.common_block()).chain(others).collect::<Vec<_>>()));
    let own = &active[effect];
    let mut of_effect = block(effect);
    for (mut column, size) in of_effect.column_iter_mut().zip(sizes(own.term.as_ref(), own.rich, natural)) {
        column *= size;
    }
    let weighed = Weighed::new(
        &basis,
        &beside(&[rest.inputs.clone(), of_effect]),
        &target(&rest.lin, rest.point),
        rest.inputs.ncols(),
    );
    let with_effect = weighed.with_effect()?;
    let with_sensor = |(doubted, columns): &(Doubted, Range<usize>)| {
        let (log, factor, errors) = weighed.with_sensor(columns)?;
        Some(rest.told(
            *doubted,
            columns.clone(),
            factor,
            log - (sensors.len() as f64).ln() - with_effect,
            &errors,
        ))
    };
    sensors.iter().filter_map(with_sensor).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

/// Normal equations of inputs and an effect, inputs first, beside everything else.
struct Weighed {
    normal: DMatrix<f64>,
    right: DVector<f64>,
    inputs: usize,
}

impl Weighed {
    fn new(basis: &DMatrix<f64>, columns: &DMatrix<f64>, y: &DVector<f64>, inputs: usize) -> Self {
        let overlap = basis.tr_mul(columns);
        let normal = columns.tr_mul(columns) - overlap.tr_mul(&overlap);
        let right = columns.tr_mul(y) - overlap.tr_mul(&basis.tr_mul(y));
        Self { normal, right, inputs }
    }

    /// Mean evidence of the effect over its widths.
    fn with_effect(&self) -> Option<f64> {
        let effect = self.inputs..self.right.len();
        let signature: f64 = effect.map(|k| self.normal[(k, k)]).sum::<f64>().sqrt();
        let tried: Vec<f64> = widths(signature)
            .into_iter()
            .filter_map(|width| Some(self.at(self.inputs..self.right.len(), width, width)?.0))
            .collect();
        Some(log_sum(tried.iter().copied()) - (tried.len() as f64).ln())
    }

    /// Mean evidence of a looser sensor over how loose it may be, without the effect; the likeliest factor, and the errors with it.
    fn with_sensor(&self, columns: &Range<usize>) -> Option<(f64, f64, DVector<f64>)> {
        let tried: Vec<(f64, f64, DVector<f64>)> = LOOSE
            .iter()
            .filter_map(|&factor| {
                let (log, errors) = self.at(columns.clone(), factor, 0.0)?;
                Some((log, factor, errors))
            })
            .collect();
        let mean = log_sum(tried.iter().map(|t| t.0)) - (tried.len() as f64).ln();
        let (_, factor, errors) = tried.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((mean, factor, errors))
    }

    /// Evidence with the effect so wide and some columns so much wider than stated.
    fn at(&self, columns: Range<usize>, factor: f64, effect: f64) -> Option<(f64, DVector<f64>)> {
        let mut scales = DVector::repeat(self.right.len(), 1.0);
        scales.rows_range_mut(self.inputs..).fill(effect);
        scales.rows_range_mut(columns).fill(factor);
        evidence(&self.normal, &self.right, &scales)
    }
}
