//! What could hide: bias of the leg stiffnesses by effects too small to be seen in these data.
//!
//! A column `t` of an effect splits into a part in the span of the springs (absorbed: it shifts the compliances by
//! `C^+ t`) and a visible rest. The effect is given the size at which a test sees the rest with 90 % power, at most its
//! largest sensible size; the shift at that size is a bias that may be there without anyone noticing.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::Judged;
use crate::candidates::{orthonormal, project, sizes, why_untestable};
use crate::evidence::WIDEST;
use crate::fit::natural;
use crate::lsq::solve;
use crate::power::{FALSE_ALARM, POWER, noncentrality};
use crate::term::Term;
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
pub fn hidden_biases(judged: &Judged<'_>) -> Vec<HiddenBias> {
    let known = |t: &dyn Term| judged.point.active.iter().any(|a| a.id() == t.info().id);
    let span = judged.lin.common_block();
    let basis = orthonormal(&span);
    let visible = noncentrality(1.0, FALSE_ALARM, POWER).sqrt();
    let mut all: Vec<HiddenBias> = Vec::new();
    for term in catalogue() {
        if known(term.as_ref()) || why_untestable(term.as_ref(), judged.campaign, &judged.lin).is_some() {
            continue;
        }
        let worst = worst_parameter(judged, term.as_ref(), &Springs { span: &span, basis: &basis, visible });
        all.extend(worst.filter(|h| largest(h) >= WORTH_TELLING));
    }
    all.sort_by(|a, b| largest(b).total_cmp(&largest(a)).then(a.term.cmp(&b.term)));
    all
}

fn largest(h: &HiddenBias) -> f64 {
    h.bias_of_leg_stiffness_percent.iter().fold(0.0, |m, b| m.max(b.abs()))
}

fn worst_parameter(judged: &Judged<'_>, term: &dyn Term, springs: &Springs<'_>) -> Option<HiddenBias> {
    let grid = term.shape_grid(&judged.lin.conditions);
    let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
    let block = judged.lin.term_block(term, false, shape);
    let natural = natural(&judged.point, &judged.lin);
    let sizes = sizes(term, false, &natural);
    let parameters = term.info().parameters.iter().enumerate();
    let biases = parameters.filter_map(|(k, p)| {
        let (size, would_show, shift) = springs.hidden(&block.column(k).into_owned(), WIDEST * sizes[k])?;
        let percent = |leg: usize| -100.0 * shift[leg] / (judged.point.springs[leg] + shift[leg]);
        let bias: [f64; 6] = std::array::from_fn(percent);
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

/// What springs (and frames) can absorb.
struct Springs<'a> {
    span: &'a DMatrix<f64>,
    /// Orthonormal basis of the span.
    basis: &'a DMatrix<f64>,
    /// Length of a visible rest, in units of the noise, that a test sees.
    visible: f64,
}

impl Springs<'_> {
    /// Size of an effect with this column, whether it would show, and the shift of springs and frames at that size.
    fn hidden(&self, column: &DVector<f64>, most: f64) -> Option<(f64, bool, DVector<f64>)> {
        let mut rest = column.clone();
        project(self.basis, &mut rest);
        let shows_at = self.visible / rest.norm();
        let (size, would_show) = if shows_at < most { (shows_at, true) } else { (most, false) };
        let shift = solve(self.span, column).ok()?.x * size;
        Some((size, would_show, shift)).filter(|(size, ..)| size.is_finite())
    }
}
