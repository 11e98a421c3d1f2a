//! What could hide: bias of the leg stiffnesses by effects too small to be seen in these data.
//!
//! A column `t` of an effect splits into a part in the span of the springs (absorbed: it shifts the compliances by
//! `C^+ t`) and a visible rest. The effect is given the size at which a test sees the rest with 90 % power, at most its
//! largest sensible size; the shift at that size is a bias that may be there without anyone noticing.

use nalgebra::DVector;
use serde::Serialize;

use super::JudgedModel;
use crate::effects::sizes::{WIDEST, sizes};
use crate::effects::term::Term;
use crate::effects::untestable::why_untestable;
use crate::estimation::fit::natural;
use crate::inference::absorption::{Absorption, bias_percent};
use crate::inference::power::{FALSE_ALARM, POWER, noncentrality};
use crate::terms::catalogue;

/// Biases below this are not worth telling, percent.
const WORTH_TELLING: f64 = 0.5;

/// Bias by one parameter of an effect.
#[derive(Debug, Clone, Serialize)]
pub struct HiddenBias {
    /// Id of the term.
    pub term: String,
    /// Its parameter.
    pub parameter: &'static str,
    /// Size that these data would just show, or the largest sensible one.
    pub size: f64,
    /// Unit of the size.
    pub unit: &'static str,
    /// False when even the largest sensible size would not show.
    pub would_show: bool,
    /// Change of each leg stiffness when an effect of that size is left out, percent.
    pub bias_of_leg_stiffness_percent: [f64; 6],
}

/// The most harmful parameter of every effect that is not in the model, worst effect first.
pub fn hidden_biases(judged: &JudgedModel<'_>) -> Vec<HiddenBias> {
    let known = |t: &dyn Term| judged.point.active.iter().any(|a| a.id() == t.info().id);
    let absorption = Absorption::of(&judged.lin);
    let visible = noncentrality(1.0, FALSE_ALARM, POWER).sqrt();
    let mut all: Vec<HiddenBias> = Vec::new();
    for term in catalogue() {
        if known(term.as_ref()) || why_untestable(term.as_ref(), judged.campaign, &judged.lin).is_some() {
            continue;
        }
        let worst = worst_parameter(judged, term.as_ref(), &absorption, visible);
        all.extend(worst.filter(|h| largest(h) >= WORTH_TELLING));
    }
    all.sort_by(|a, b| largest(b).total_cmp(&largest(a)).then(a.term.cmp(&b.term)));
    all
}

fn largest(h: &HiddenBias) -> f64 {
    h.bias_of_leg_stiffness_percent.iter().fold(0.0, |m, b| m.max(b.abs()))
}

fn worst_parameter(
    judged: &JudgedModel<'_>,
    term: &dyn Term,
    absorption: &Absorption,
    visible: f64,
) -> Option<HiddenBias> {
    let grid = term.shape_grid(&judged.lin.conditions);
    let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
    let block = judged.lin.term_block(term, false, shape);
    let natural = natural(judged.point, &judged.lin);
    let sizes = sizes(term, false, shape, &natural);
    let parameters = term.info().parameters.iter().enumerate();
    let biases = parameters.filter_map(|(k, p)| {
        let column = block.column(k).into_owned();
        let (size, would_show, shift) = hidden(absorption, &column, WIDEST * sizes[k], visible)?;
        let bias = bias_percent(&judged.point.compliances, &shift);
        bias.iter().all(|b| b.is_finite()).then(|| HiddenBias {
            term: term.info().id.to_owned(),
            parameter: p.name,
            size: size * p.per_si,
            unit: p.unit,
            would_show,
            bias_of_leg_stiffness_percent: bias,
        })
    });
    biases.max_by(|a, b| largest(a).total_cmp(&largest(b)))
}

/// Size of an effect with this column, at most `most`; whether it would show; the shift of springs and frames at that size.
/// `visible`: length of a rest that a test sees, in units of the noise.
fn hidden(
    absorption: &Absorption,
    column: &DVector<f64>,
    most: f64,
    visible: f64,
) -> Option<(f64, bool, DVector<f64>)> {
    let shows_at = visible / absorption.rest(column).norm();
    let (size, would_show) = if shows_at < most { (shows_at, true) } else { (most, false) };
    let shift = absorption.shift(column)? * size;
    Some((size, would_show, shift)).filter(|(size, ..)| size.is_finite())
}
