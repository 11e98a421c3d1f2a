//! A sensor that stands or looks elsewhere, or a load cell that is off, where an effect is seen.
//!
//! One gauge among three that looks at another point of the platform leaves much the same readings as three gauges whose platform is
//! registered beside its origin, or as a platform that yields; so does one component of the load cell that reads too much, as a base that
//! yields. Both explanations are weighed alike, each by its mean evidence over the widths that it may have, beside the springs and the
//! other effects found:
//!
//! ```text
//! ln odds = ln Z(input to a wider tolerance, without the effect) - ln Z(inputs as stated, with the effect)
//! ```

use std::ops::Range;

use nalgebra::DMatrix;

use super::remainder::Remainder;
use super::tolerance::{
    Doubted, Tolerance, Widest, WithinTolerances, count_of, gains_doubted, sensors_doubted,
};
use crate::effects::sizes::sizes;
use crate::effects::term::Natural;
use crate::estimation::linearization::Active;
use crate::estimation::tolerances::InputKind;
use crate::inference::evidence::widths;

/// The input that explains most of what an effect found is taken to explain; its evidence is that over the effect, nats.
pub(super) fn instead_of_effects(rest: &Remainder<'_>, natural: &Natural) -> Option<Tolerance> {
    let gains = (Doubted::Inputs(InputKind::LoadGain), InputKind::LoadGain.columns());
    let mut inputs = sensors_doubted(rest);
    inputs.push(gains);
    inputs.extend(gains_doubted());
    let effects = 0..rest.point.active.len();
    let all = effects.filter_map(|effect| instead_of(rest, natural, effect, &inputs));
    all.max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

fn instead_of(
    rest: &Remainder<'_>,
    natural: &Natural,
    effect: usize,
    inputs: &[(Doubted, Range<usize>)],
) -> Option<Tolerance> {
    let active = &rest.point.active;
    let block = |k: usize| rest.lin.term_block(active[k].term.as_ref(), active[k].rich, active[k].shape);
    let others = (0..active.len()).filter(|k| *k != effect).map(block);
    let all: Vec<_> = std::iter::once(rest.lin.common_block()).chain(others).collect();
    let known = WithinTolerances::beside(rest, &all)?;
    let own = known.and(scaled(block(effect), &active[effect], natural));
    // What an effect that explains nothing is taken for needs no other explanation.
    let with_effect = own.widest(&widths(own.signature()))?.evidence.max(0.0);
    let tried = count_of(inputs.iter().map(|(doubted, _)| *doubted));
    let with_input = |(doubted, columns): &(Doubted, Range<usize>)| {
        let own = known.doubting(*doubted, columns)?;
        let (as_stated, _) = own.evidence(if *doubted == Doubted::Moments { 0.0 } else { 1.0 })?;
        let Widest { evidence, factor, errors } = own.widest(doubted.factors())?;
        let odds = evidence - as_stated - tried.ln() - doubted.rarity() - with_effect;
        Some(rest.told(*doubted, factor, odds, &errors))
    };
    inputs.iter().filter_map(with_input).max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

/// Columns of an effect by its natural sizes.
fn scaled(mut columns: DMatrix<f64>, effect: &Active, natural: &Natural) -> DMatrix<f64> {
    let sizes = sizes(effect.term.as_ref(), effect.rich, effect.shape, natural);
    for (mut column, size) in columns.column_iter_mut().zip(sizes) {
        column *= size;
    }
    columns
}
