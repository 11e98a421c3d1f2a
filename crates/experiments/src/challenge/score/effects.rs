//! Numbers of the hidden effects against the true ones.
//!
//! A number of an effect is stated as `EFFECT.PARAMETER` in the unit in which the catalogue shows it. Errors of an effect are told in the root
//! mean square of its true numbers of the same unit, so that six compliances and one gap compare. Whoever leaves a number of a
//! hidden effect out has no score: who states the easy ones alone shall not be ahead.

use hexbench_core::Measurand;
use hexbench_core::statistics::root_mean_square;
use hexbench_model::effects::term::{ParameterInfo, TermInfo};
use hexbench_model::terms::catalogue;

use super::key::AnswerKey;
use super::proper::ProperScore;
use crate::challenge::answer::Number;
use crate::recovery::correspondence::equivalent;

/// A true number as it should be stated.
struct TrueNumber {
    name: String,
    unit: &'static str,
    value: f64,
}

/// Proper scores of the numbers of all hidden effects; none where one is outside the catalogue or not stated in full, and of
/// absolute poses, whose numbers the frames of the instrument share.
pub(super) fn effect_numbers(key: &AnswerKey, stated: &[Number]) -> Option<ProperScore> {
    if key.measurand == Measurand::AbsolutePose {
        return None;
    }
    let mut scores = Vec::new();
    for id in &key.truth.effects {
        let all = true_numbers(id, key)?;
        for number in &all {
            let found = stated.iter().find(|n| n.name == number.name && n.unit == number.unit)?;
            let of_unit = all.iter().filter(|n| n.unit == number.unit).map(|n| n.value);
            let size = root_mean_square(of_unit).filter(|size| *size > 0.0)?;
            scores.push(ProperScore::of(found.value - number.value, found.std).times(size.recip()));
        }
    }
    ProperScore::mean(&scores)
}

fn true_numbers(id: &str, key: &AnswerKey) -> Option<Vec<TrueNumber>> {
    let terms = catalogue();
    let info: &TermInfo = terms.iter().map(|term| term.info()).find(|info| info.id == id)?;
    let true_values = equivalent(id, &key.truth.parameters, &key.hexapod)?.values;
    let number = |(parameter, value): (&ParameterInfo, Option<f64>)| {
        let value = value? * parameter.per_si;
        Some(TrueNumber { name: format!("{id}.{}", parameter.name), unit: parameter.unit, value })
    };
    let all: Vec<TrueNumber> = info.parameters.iter().zip(true_values).filter_map(number).collect();
    (!all.is_empty()).then_some(all)
}
