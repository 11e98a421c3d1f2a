//! Explanations that somebody suspects, fitted to the data in hand.

use std::sync::Arc;

use super::{RivalExplanation, RivalForm};
use crate::effects::sizes::sizes;
use crate::effects::term::Term;
use crate::effects::untestable::why_untestable;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{TermSpec, fit};
use crate::inference::diagnosis::{RankedSets, explain};
use crate::inference::search::Set;

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
    let sets: Vec<Option<&Set>> = terms.iter().map(|t| alone(t, &outcome)).collect();
    let first = sets.iter().find_map(|s| Some((*s)?.log_weight)).unwrap_or(0.0);
    let mut rivals = Vec::new();
    for (term, set) in terms.iter().zip(&sets) {
        let preferred = set.and_then(|s| outcome.wanted(s).pop());
        let fit = fit(campaign, &[preferred.unwrap_or_else(|| natural(term, &outcome))], None)?;
        let forms = set.map_or_else(Vec::new, |s| RivalForm::left_open(campaign, s, &outcome));
        rivals.push(RivalExplanation { terms: vec![term.info().id.to_owned()], weight: 1.0, fit, forms });
    }
    let log_evidence = sets.iter().map(|s| Some((*s)?.log_weight - first)).collect();
    Ok(Suspects { rivals, log_evidence })
}

/// The set of one effect alone, in the form, shape and width that the data prefer; none where no sensible size of it would show.
fn alone<'a>(term: &Arc<dyn Term>, outcome: &'a RankedSets) -> Option<&'a Set> {
    let id = Some(term.info().id);
    outcome.sets.sets.iter().find(|s| matches!(s.members[..], [m] if outcome.candidates[m].id() == id))
}

/// The natural size of an effect of which the data say nothing.
fn natural(term: &Arc<dyn Term>, outcome: &RankedSets) -> TermSpec {
    let grid = term.shape_grid(&outcome.lin.conditions);
    let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
    let prior = sizes(term.as_ref(), false, shape, &outcome.natural);
    TermSpec { term: Arc::clone(term), rich: false, shape, prior }
}
