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

use nalgebra::DMatrix;

use super::remainder::Remainder;
use super::tolerance::{Doubted, LOOSE, Tolerance, Widest, WithinTolerances, sensors_doubted};
use crate::effects::term::Natural;
use crate::estimation::linearization::Active;
use crate::inference::candidates::sizes;
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
    let known = WithinTolerances::beside(rest, &all)?;
    let own = known.and(scaled(block(effect), &active[effect], natural));
    let with_effect = own.widest(&widths(own.signature()))?.evidence;
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
