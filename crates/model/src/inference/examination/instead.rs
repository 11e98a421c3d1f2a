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
use super::tolerance::{Doubted, LOOSE, Reduced, Tolerance, Widest, WithinTolerances, sensors_doubted};
use crate::effects::term::Natural;
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::linearization::{Active, beside};
use crate::inference::candidates::{sizes, target};
use crate::inference::evidence::widths;

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
    let all: Vec<_> = std::iter::once(rest.lin.common_block()).chain(others).collect();
    let basis = orthonormal(&beside(&all));
    let mut y = target(&rest.lin, rest.point);
    project(&basis, &mut y);
    let overlap = basis.tr_mul(rest.inputs);
    let normal = rest.inputs.tr_mul(rest.inputs) - overlap.tr_mul(&overlap);
    let right = rest.inputs.tr_mul(&y);
    let mut of_effect = scaled(block(effect), &active[effect], natural);
    of_effect -= &basis * basis.tr_mul(&of_effect);
    let with_effect = evidence_of(&of_effect, rest.inputs, &normal, &y)?;
    let known = WithinTolerances::new(&normal, &right)?;
    let with_sensor = |(doubted, columns): &(Doubted, Range<usize>)| {
        let own = known.of(columns)?;
        let (as_stated, _) = own.evidence(1.0)?;
        let Widest { evidence, factor, errors } = own.widest(&LOOSE)?;
        let odds = evidence - as_stated - (sensors.len() as f64).ln() - with_effect;
        Some(rest.told(*doubted, factor, odds, &errors))
    };
    sensors.iter().filter_map(with_sensor).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

/// Columns of an effect by its natural sizes.
fn scaled(mut columns: DMatrix<f64>, effect: &Active, natural: &Natural) -> DMatrix<f64> {
    let sizes = sizes(effect.term.as_ref(), effect.rich, natural);
    for (mut column, size) in columns.column_iter_mut().zip(sizes) {
        column *= size;
    }
    columns
}

/// Mean evidence of an effect over its widths, beside inputs within their tolerances.
fn evidence_of(
    effect: &DMatrix<f64>,
    inputs: &DMatrix<f64>,
    normal: &DMatrix<f64>,
    y: &DVector<f64>,
) -> Option<f64> {
    let factor = (normal + DMatrix::identity(normal.nrows(), normal.ncols())).cholesky()?;
    let across = inputs.tr_mul(effect);
    let own = effect.tr_mul(effect) - across.tr_mul(&factor.solve(&across));
    let right = effect.tr_mul(y) - across.tr_mul(&factor.solve(&inputs.tr_mul(y)));
    let widths = widths(own.trace().max(0.0).sqrt());
    Some(Reduced { normal: own, right }.widest(&widths)?.evidence)
}
