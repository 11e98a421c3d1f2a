//! What remains when the fitted model has explained what it can.

use hexbench_core::words::joined;
use hexbench_model::results::compare::association::Association;
use hexbench_model::results::diagnose::{Diagnosis, LegRemainder};

use super::comparison::who;
use crate::number::{multiple, significant};
use crate::page::{Block, PageColumn, Section, Table};

/// How large it is, in which legs, and what it follows.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    let remainder = d.remainder.as_ref()?;
    let follows = (!has_a_pattern(d)).then(|| Block::paragraph(followed(&remainder.follows)));
    Some(of_legs(remainder.times_noise, &remainder.legs).with(follows))
}

/// The same without what it follows; `times_noise` is the error on held-out poses without the noise's own.
pub(super) fn of_legs(times_noise: f64, legs: &[LegRemainder]) -> Section {
    let lead = format!(
        "On held-out poses, the error of the fitted model beyond the noise is {} times the noise. The stiffness of each leg listed is \
         uncertain by the percentage shown; the uncertainty above includes this.",
        multiple(times_noise)
    );
    let columns = [PageColumn::words("leg"), PageColumn::number("um"), PageColumn::number("% of its spring")];
    let row = |leg: &LegRemainder| {
        [leg.leg.to_string(), significant(leg.elongation_um, 2), significant(leg.percent_of_spring, 2)]
    };
    Section::new("What remains")
        .remark("elongation of the legs that the model does not explain, root mean square")
        .paragraph(lead)
        .table(Table::new(columns).rows(legs.iter().map(row)))
}

/// True when the verdict has told what it follows.
fn has_a_pattern(d: &Diagnosis) -> bool {
    d.outside.as_ref().is_some_and(|outside| outside.pattern.is_some())
}

/// `It follows leg_length (compliance of all legs) and elapsed_s (length of leg 3).`
fn followed(follows: &[Association]) -> String {
    let one = |a: &Association| format!("{} ({} of {})", a.variable, a.of, who(a.leg));
    let names: Vec<String> = follows.iter().map(one).collect();
    if names.is_empty() {
        "It correlates significantly with no single variable.".to_owned()
    } else {
        format!("It follows {}.", joined(&names))
    }
}
