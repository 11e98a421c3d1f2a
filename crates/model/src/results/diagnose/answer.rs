//! What is said of the machine, once it is settled which readings count.

use super::averaged::averaged_springs;
use super::context::Context;
use super::report::StepReport;
use crate::error::ModelError;
use crate::estimation::estimate::{Estimates, estimates, estimates_with};
use crate::estimation::fit::{Fit, TermSpec};
use crate::inference::diagnosis::{RankedSets, wanted};
use crate::inference::examination::Finding;
use crate::inference::search::Set;
use crate::inference::verdict::{Judgement, Verdict, judge};

/// Verdict and numbers.
pub(super) struct Answer {
    pub(super) judgement: Judgement,
    /// Terms of the model, in the order in which they are added.
    pub(super) order: Vec<TermSpec>,
    /// Fits of the steps.
    pub(super) fits: Vec<Fit>,
    pub(super) steps: Vec<StepReport>,
    /// Effects named.
    pub(super) added: Vec<String>,
    pub(super) numbers: Estimates,
}

impl Answer {
    pub(super) fn of(context: &Context<'_>, findings: &[Finding]) -> Result<Self, ModelError> {
        if findings.iter().any(|f| f.kind.is_of_file()) {
            return Self::of_misread(context);
        }
        let outcome = context.outcome;
        let mut judgement = judge(&outcome.sets, &outcome.candidates);
        let best = outcome.sets.sets.first();
        let order = best.map(|s| addition_order(s, outcome)).unwrap_or_default();
        let (fits, steps) = context.steps(&order)?;
        demote_what_does_not_survive(&mut judgement, &steps);
        let last = fits.last().unwrap_or(&outcome.baseline);
        context.face_holdout(&mut judgement, last);
        if judgement.verdict == Verdict::Adequate {
            judgement.verdict = match (context.can_judge(last), findings.is_empty()) {
                (false, _) => Verdict::Undecided,
                (true, true) => Verdict::Adequate,
                (true, false) => Verdict::Measurement,
            };
        }
        let numbers = estimates_with(&averaged_springs(outcome, last), last);
        Ok(Self { added: named(&judgement, &order), judgement, order, fits, steps, numbers })
    }

    /// A file that does not mean what it says: nothing follows for the machine, and no number is given.
    fn of_misread(context: &Context<'_>) -> Result<Self, ModelError> {
        let (fits, steps) = context.steps(&[])?;
        let known = estimates(&context.outcome.baseline);
        let names = known.determined.into_iter().map(|e| e.name).chain(known.not_determined);
        let numbers = Estimates { determined: Vec::new(), not_determined: names.collect() };
        let judgement = Judgement::of_the_data();
        Ok(Self { judgement, order: Vec::new(), fits, steps, added: Vec::new(), numbers })
    }
}

/// Effects that are sure, where the verdict names any.
fn named(judgement: &Judgement, order: &[TermSpec]) -> Vec<String> {
    if !matches!(judgement.verdict, Verdict::Named | Verdict::Ambiguous) {
        return Vec::new();
    }
    let ids = order.iter().map(|w| w.term.info().id.to_owned());
    ids.filter(|id| judgement.sure.contains(id)).collect()
}

/// Terms of a set, the one that explains most alone first.
fn addition_order(set: &Set, outcome: &RankedSets) -> Vec<TermSpec> {
    let all = wanted(set, &outcome.gram, &outcome.candidates, &outcome.natural);
    let alone = |id: &str| {
        let single = |s: &&Set| s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(id);
        outcome.sets.sets.iter().find(single).map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let mut order = all;
    order.sort_by(|a, b| alone(b.term.info().id).total_cmp(&alone(a.term.info().id)));
    order
}

/// An effect whose addition does not make held-out readings better predicted is not named.
fn demote_what_does_not_survive(judgement: &mut Judgement, steps: &[StepReport]) {
    for pair in steps.windows(2) {
        let Some(newest) = pair[1].terms.last() else { continue };
        let better = match (&pair[0], &pair[1]) {
            (StepReport { log_density: Some(before), .. }, StepReport { log_density: Some(after), .. }) => {
                after > before
            }
            (StepReport { holdout: Some(before), .. }, StepReport { holdout: Some(after), .. }) => {
                after.chi2_reduced < before.chi2_reduced
            }
            _ => continue,
        };
        if !better && judgement.sure.contains(newest) {
            judgement.sure.retain(|id| id != newest);
            if judgement.verdict == Verdict::Named {
                judgement.verdict = Verdict::Ambiguous;
            }
        }
    }
}
