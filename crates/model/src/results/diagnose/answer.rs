//! What is said of the machine, once it is settled which readings count.

use super::averaged::averaged_springs;
use super::context::Context;
use super::report::StepReport;
use crate::error::ModelError;
use crate::estimation::estimate::{Estimates, LegCompliances, estimates, estimates_with};
use crate::estimation::fit::{Fit, TermSpec};
use crate::estimation::linearization::Linearization;
use crate::inference::diagnosis::RankedSets;
use crate::inference::discrepancy::LegDiscrepancy;
use crate::inference::examination::{Finding, is_misread};
use crate::inference::gain::WORTH_NAMING;
use crate::inference::search::Set;
use crate::inference::verdict::{Judgement, Verdict, judge};

/// Verdict and numbers.
pub(super) struct Answer {
    pub(super) judgement: Judgement,
    /// Terms of the model, in the order in which they are added.
    pub(super) order: Vec<TermSpec>,
    /// Fits of the steps.
    pub(super) fits: Vec<Fit>,
    /// The campaign at the last of them.
    pub(super) lin: Linearization,
    pub(super) steps: Vec<StepReport>,
    /// Effects named.
    pub(super) added: Vec<String>,
    /// Sure effects that are not worth naming.
    pub(super) small: Vec<String>,
    /// What the last fit leaves of the legs.
    pub(super) left: LegDiscrepancy,
    pub(super) numbers: Estimates,
}

impl Answer {
    pub(super) fn of(context: &Context<'_>, findings: &[Finding]) -> Result<Self, ModelError> {
        if is_misread(findings) {
            return Self::of_misread(context);
        }
        let outcome = context.outcome;
        let mut judgement = judge(&outcome.sets, &outcome.candidates);
        let best = outcome.sets.sets.first();
        let mut order = best.map(|s| addition_order(s, outcome)).unwrap_or_default();
        let (mut fits, mut steps) = context.steps(&order)?;
        demote_what_does_not_survive(&mut judgement, &steps);
        let last = fits.last().unwrap_or(&outcome.baseline);
        // Held-out readings are too few to show what is small: not to show there is no reason for doubt.
        if judgement.verdict == Verdict::Outside && context.share_outside(last) < WORTH_NAMING {
            judgement.pass_over_outside();
        }
        context.face_holdout(&mut judgement, last);
        let small = withdraw_what_is_small(&mut judgement, &steps);
        if judgement.verdict == Verdict::Adequate {
            judgement.verdict = match (context.can_judge(last), findings.iter().all(Finding::is_as_stated)) {
                (false, _) => Verdict::Undecided,
                (true, true) => Verdict::Adequate,
                (true, false) => Verdict::Measurement,
            };
        }
        let kept = if judgement.verdict == Verdict::Outside { best_step(&steps) } else { order.len() };
        let imitates = kept < order.len();
        order.truncate(kept);
        fits.truncate(kept + 1);
        steps.truncate(kept + 1);
        let last = fits.last().unwrap_or(&outcome.baseline);
        let lin = Linearization::at(context.campaign, &last.point)?;
        let left = LegDiscrepancy::of(context.campaign, &lin, last.lack_of_fit_dof);
        let springs = if imitates { LegCompliances::of(last) } else { averaged_springs(outcome, last) };
        let numbers = estimates_with(&springs.open_by(&left.share), last);
        let added = named(&judgement, &order);
        Ok(Self { judgement, order, fits, lin, steps, added, small, left, numbers })
    }

    /// A file that does not mean what it says: nothing follows for the machine, and no number is given.
    fn of_misread(context: &Context<'_>) -> Result<Self, ModelError> {
        let (fits, steps) = context.steps(&[])?;
        let known = estimates(&context.outcome.baseline);
        let names = known.determined.into_iter().map(|e| e.name).chain(known.not_determined);
        let numbers = Estimates { determined: Vec::new(), not_determined: names.collect() };
        Ok(Self {
            judgement: Judgement::of_the_data(),
            order: Vec::new(),
            lin: Linearization::at(context.campaign, &context.outcome.baseline.point)?,
            fits,
            steps,
            added: Vec::new(),
            small: Vec::new(),
            left: LegDiscrepancy::default(),
            numbers,
        })
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
    let all = outcome.wanted(set);
    let alone = |id: &str| {
        let single = |s: &&Set| s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(id);
        outcome.sets.sets.iter().find(single).map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let mut order = all;
    order.sort_by(|a, b| alone(b.term.info().id).total_cmp(&alone(a.term.info().id)));
    order
}

/// The step that predicts held-out readings best. Beside something unknown, what is added after it only imitates that in the readings
/// fitted.
fn best_step(steps: &[StepReport]) -> usize {
    let chi2 = |step: usize| held_out_chi2(&steps[step]);
    (0..steps.len()).min_by(|&a, &b| chi2(a).total_cmp(&chi2(b))).unwrap_or(0)
}

/// Reduced chi-square of held-out readings; infinite where there are none.
fn held_out_chi2(step: &StepReport) -> f64 {
    step.holdout.map_or(f64::INFINITY, |errors| errors.chi2_reduced)
}

/// An effect that does not stay sure on held-out readings is not named.
fn demote_what_does_not_survive(judgement: &mut Judgement, steps: &[StepReport]) {
    for step in steps {
        let Some(newest) = step.terms.last() else { continue };
        let probability = judgement.present.get(newest).copied().unwrap_or(0.0);
        let survives = step.gain.is_none_or(|gain| gain.leaves_sure(probability));
        if !survives && judgement.sure.contains(newest) {
            judgement.sure.retain(|id| id != newest);
            if judgement.verdict == Verdict::Named {
                judgement.verdict = Verdict::Ambiguous;
            }
        }
    }
}

/// Takes sure effects that are too small to be named out of a judgment; without any other the springs are good enough.
fn withdraw_what_is_small(judgement: &mut Judgement, steps: &[StepReport]) -> Vec<String> {
    let least = steps.iter().map(held_out_chi2).fold(f64::INFINITY, f64::min);
    let is_small = |step: &&StepReport| {
        step.worth.is_some_and(|worth| worth.is_small_beside_all([held_out_chi2(step), least]))
    };
    let newest = steps.iter().filter(is_small).filter_map(|step| step.terms.last());
    let small: Vec<String> = newest.filter(|id| judgement.sure.contains(id)).cloned().collect();
    judgement.sure.retain(|id| !small.contains(id));
    if judgement.verdict == Verdict::Named && judgement.sure.is_empty() {
        judgement.verdict = Verdict::Adequate;
    }
    small
}
