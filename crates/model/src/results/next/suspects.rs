//! Explanations that somebody suspects, fitted to the data in hand.

use std::sync::Arc;

use super::RivalExplanation;
use crate::effects::term::Term;
use crate::effects::untestable::why_untestable;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{TermSpec, fit};
use crate::inference::candidates::sizes;
use crate::inference::diagnosis::{RankedSets, explain, wanted};

/// Suspected explanations and how the data in hand judge them.
pub struct Suspects {
    /// In the order in which they were given.
    pub rivals: Vec<RivalExplanation>,
    /// Logarithm of the evidence of each, relative to the first; none where no sensible size of it would show in these data.
    pub log_evidence: Vec<Option<f64>>,
}

/// Each suspect with springs (and frames), fitted; all are weighed as equally probable.
///
/// # Errors
/// As [`fit`]; [`ModelError::Untestable`] for a term whose columns are missing.
pub fn suspects(campaign: &Campaign, terms: &[Arc<dyn Term>]) -> Result<Suspects, ModelError> {
    let outcome = explain(campaign, terms)?;
    let lin = &outcome.lin;
    for term in terms {
        if let Some(why) = why_untestable(term.as_ref(), campaign, lin) {
            return Err(ModelError::Untestable { id: term.info().id.to_owned(), why });
        }
    }
    let alone: Vec<(TermSpec, Option<f64>)> = terms.iter().map(|t| alone(t, &outcome)).collect();
    let first = alone.iter().find_map(|a| a.1).unwrap_or(0.0);
    let mut rivals = Vec::new();
    for (wanted, _) in &alone {
        let fit = fit(campaign, std::slice::from_ref(wanted), None)?;
        rivals.push(RivalExplanation { terms: vec![wanted.term.info().id.to_owned()], weight: 1.0, fit });
    }
    Ok(Suspects { rivals, log_evidence: alone.iter().map(|a| a.1.map(|e| e - first)).collect() })
}

/// The form, shape and width that the data prefer, and the evidence; the natural size where the data say nothing.
fn alone(term: &Arc<dyn Term>, outcome: &RankedSets) -> (TermSpec, Option<f64>) {
    let single =
        outcome.sets.sets.iter().find(
            |s| matches!(s.members.as_slice(), [m] if outcome.candidates[*m].id() == Some(term.info().id)),
        );
    let preferred = single.and_then(|s| {
        let mut all = wanted(s, &outcome.gram, &outcome.candidates, &outcome.natural);
        Some((all.pop()?, Some(s.log_weight)))
    });
    preferred.unwrap_or_else(|| {
        let grid = term.shape_grid(&outcome.lin.conditions);
        let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
        let prior = sizes(term.as_ref(), false, &outcome.natural);
        (TermSpec { term: Arc::clone(term), rich: false, shape, prior }, None)
    })
}
