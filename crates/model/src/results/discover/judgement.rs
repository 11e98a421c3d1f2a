//! From sets with laws to what is said of them.

use std::collections::BTreeMap;

use super::report::{Discovery, HeldOutFall, LawReport};
use super::{DiscoveryReason, Source};
use crate::error::ModelError;
use crate::estimation::estimate::{Estimate, estimates};
use crate::estimation::fit::{Fit, TermSpec};
use crate::estimation::fit_named::asked_as;
use crate::inference::diagnosis::RankedSets;
use crate::inference::discovery::{LawSum, LawTerm};
use crate::inference::gain::GainOutcome;
use crate::inference::search::Set;
use crate::inference::verdict::NAMED;
use crate::results::diagnose::{Context, MOST_RIVALS, NextReadings, StepReport};
use crate::results::next::RivalExplanation;

/// Most laws that are told.
pub const MOST_LAWS: usize = 5;
/// Ideas told where no law convinces.
pub(super) const IDEAS: usize = 3;
/// Probability above which a law counts as one that these readings do not tell from the best.
const ALIKE: f64 = 0.02;
/// Share of the excess over the noise that a single law has to take off the held-out error, at least, where some remains; a sum of laws
/// that leaves something is a description, not what is at work.
const MOST_OF_IT: f64 = 0.9;
/// Chance of an error as large as this below which something else is missing: so many right laws are passed over.
const LEAST_CHANCE: f64 = 0.001;

/// What is said of the laws.
pub(super) struct Judged {
    /// True when the first proposal convinces.
    pub(super) convinces: bool,
    /// Chance that noise and tolerances leave as much as it does.
    pub(super) chance: f64,
    /// What held-out readings gain by the laws of the first proposal, nats.
    pub(super) gain: f64,
    beside: Vec<String>,
    laws: Vec<LawReport>,
    pub(super) steps: Vec<StepReport>,
    pub(super) fits: Vec<Fit>,
    probability: f64,
    /// Term files of the laws, in their order.
    pub(super) term_files: Vec<String>,
    /// Readings that separate the first law from those that look like it.
    next: NextReadings,
}

/// Laws that stand in a set together, by their places in the list of laws.
type Members = Vec<usize>;

/// Weights of sets summed over what they contain.
struct Weights<'a> {
    /// Probability that a law is at work.
    of_laws: f64,
    /// Proposals, best set first, with the probability of each and its best set.
    proposals: Vec<(Members, f64, &'a Set)>,
    /// Probability of each effect of the catalogue.
    of_effect: BTreeMap<&'static str, f64>,
}

impl Judged {
    /// Judges the best proposal; where it convinces, tells those that look like it too, else `ideas` at most.
    pub(super) fn of(
        context: &Context<'_>,
        laws: &[LawTerm],
        source: &Source<'_>,
        ideas: usize,
    ) -> Result<Self, ModelError> {
        let weights = Weights::of(context.outcome, laws);
        let mut judged = Self {
            convinces: false,
            chance: 0.0,
            gain: 0.0,
            beside: Vec::new(),
            laws: Vec::new(),
            steps: Vec::new(),
            fits: Vec::new(),
            probability: weights.of_laws,
            term_files: Vec::new(),
            next: NextReadings::default(),
        };
        let mut rivals = Vec::new();
        for (rank, (members, probability, set)) in weights.proposals.iter().take(MOST_LAWS).enumerate() {
            let is_told = if judged.convinces { *probability >= ALIKE } else { rank < ideas.max(1) };
            if !is_told {
                break;
            }
            let order = weights.order(set, context.outcome, laws);
            let beside = order.len() - members.len();
            let (fits, steps) = if rank == 0 {
                context.steps(&order)?
            } else {
                context.steps_at(&order, [beside, order.len()])?
            };
            let Some(fitted) = fits.last() else { continue };
            let mine: Vec<&LawTerm> = in_order(members, &order[beside..], laws);
            let sum = LawSum::fitted(mine, &fitted.point.active);
            if rank == 0 {
                judged.chance = chance(context, fitted, steps.last());
                let is_whole = judged.is_at_the_noise() || (members.len() == 1 && takes_most(&steps));
                judged.convinces = weights.of_laws >= NAMED
                    && is_whole
                    && foresees(&steps[beside..])
                    && agree(&steps[beside + 1..], weights.of_laws)
                    && !steps.iter().filter_map(|s| s.gain).any(|gain| gain.outcome == GainOutcome::Refuted);
                judged.gain = steps[beside + 1..].iter().filter_map(|s| s.gain).map(|gain| gain.nats).sum();
                judged.beside = order[..beside].iter().map(|w| asked_as(w.term.info().id, w.rich)).collect();
            }
            let before = if rank == 0 { beside } else { 0 };
            let report = report(rank + 1, &sum, *probability, fitted, &steps[before..], beside);
            if report.probability >= ALIKE && rivals.len() < MOST_RIVALS {
                let (terms, weight) = (vec![report.id.clone()], report.probability);
                rivals.push(RivalExplanation { terms, weight, fit: fitted.clone(), forms: Vec::new() });
            }
            judged.term_files.push(sum.file(&context.outcome.lin, &source.comments(&report)));
            if rank == 0 {
                (judged.steps, judged.fits) = (steps, fits);
            }
            judged.laws.push(report);
        }
        name_alike(&mut judged.laws);
        if judged.convinces && rivals.len() > 1 {
            judged.next = NextReadings::of(&context.proposed(&rivals), &rivals);
        }
        Ok(judged)
    }

    /// True when nothing is left with the first proposal.
    pub(super) fn is_at_the_noise(&self) -> bool {
        self.chance > LEAST_CHANCE
    }

    /// The discovery of a law.
    pub(super) fn report(&self, template: Discovery) -> Discovery {
        Discovery {
            found: true,
            reason: DiscoveryReason::Law,
            text: self.laws.first().map(|l| l.text.clone()).unwrap_or_default(),
            beside: self.beside.clone(),
            laws: self.laws.clone(),
            steps: self.steps.clone(),
            probability: self.probability,
            next: self.next.readings.clone(),
            separation: self.next.separation.clone(),
            ..template
        }
    }

    /// What the laws come to where none convinces.
    pub(super) fn ideas(&self, template: Discovery) -> Discovery {
        let is_open = template.reason == DiscoveryReason::NoLawConvinces;
        let laws = if is_open { self.laws.clone() } else { Vec::new() };
        Discovery { laws, probability: self.probability, ..template }
    }
}

impl<'a> Weights<'a> {
    fn of(outcome: &'a RankedSets, laws: &[LawTerm]) -> Self {
        let mut weights = Self { of_laws: 0.0, proposals: Vec::new(), of_effect: BTreeMap::new() };
        for set in &outcome.sets.sets {
            let probability = outcome.sets.probability(set) + outcome.sets.discrepant_probability(set);
            let ids = || set.members.iter().filter_map(|&m| outcome.candidates[m].id());
            for id in ids().filter(|id| index_of(id, laws).is_none()) {
                *weights.of_effect.entry(id).or_default() += probability;
            }
            let members: Members = ids().filter_map(|id| index_of(id, laws)).collect();
            if members.is_empty() {
                continue;
            }
            weights.of_laws += probability;
            match weights.proposals.iter_mut().find(|p| p.0 == members) {
                Some(known) => known.1 += probability,
                None => weights.proposals.push((members, probability, set)),
            }
        }
        weights.of_laws = weights.of_laws.min(1.0);
        weights
    }

    /// Terms of a set: effects of the catalogue that are sure, then laws, the one that explains most alone first.
    fn order(&self, set: &Set, outcome: &RankedSets, laws: &[LawTerm]) -> Vec<TermSpec> {
        let all = outcome.wanted(set);
        let law = |w: &TermSpec| index_of(w.term.info().id, laws);
        let is_sure = |w: &TermSpec| self.of_effect.get(w.term.info().id).is_some_and(|p| *p >= NAMED);
        let alone = |w: &TermSpec| {
            let single = |s: &&Set| {
                s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(w.term.info().id)
            };
            outcome.sets.sets.iter().find(single).map_or(f64::NEG_INFINITY, |s| s.log_weight)
        };
        let mut order: Vec<TermSpec> = all.into_iter().filter(|w| law(w).is_some() || is_sure(w)).collect();
        order.sort_by(|a, b| law(a).is_some().cmp(&law(b).is_some()).then(alone(b).total_cmp(&alone(a))));
        order
    }
}

fn index_of(id: &str, laws: &[LawTerm]) -> Option<usize> {
    laws.iter().position(|l| l.term.info().id == id)
}

fn in_order<'a>(members: &Members, order: &[TermSpec], laws: &'a [LawTerm]) -> Vec<&'a LawTerm> {
    let place = |k: &usize| order.iter().position(|w| w.term.info().id == laws[*k].term.info().id);
    let mut sorted = members.clone();
    sorted.sort_by_key(place);
    sorted.into_iter().map(|k| &laws[k]).collect()
}

/// True when laws make no error on held-out poses larger: what does is no law of the machine, however likely the readings fitted make it.
fn foresees(steps: &[StepReport]) -> bool {
    let ends = steps.first().zip(steps.last());
    ends.is_none_or(|(before, after)| after.error().chi2_reduced <= before.error().chi2_reduced)
}

/// True when held-out poses agree with every law; `of_laws`: the steps that add one each.
fn agree(of_laws: &[StepReport], probability: f64) -> bool {
    of_laws.iter().all(|step| {
        step.gain.is_none_or(|gain| gain.leaves_sure(probability))
            && step.worth.is_none_or(|worth| !worth.is_small())
    })
}

/// True when a model takes most of what is above the noise off the held-out error of the springs.
fn takes_most(steps: &[StepReport]) -> bool {
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else { return false };
    let excess = |step: &StepReport| (step.error().chi2_reduced - 1.0).max(0.0);
    1.0 - excess(last) / excess(first).max(f64::MIN_POSITIVE) >= MOST_OF_IT
}

/// Chance of all that a model leaves, in the readings fitted and in those held out, by noise and tolerances. Both are asked together: what
/// is no law of the machine may follow the ones or the others, and hardly both. Where nobody knows the noise, an error at the noise counts
/// as certain.
fn chance(context: &Context<'_>, fitted: &Fit, last: Option<&StepReport>) -> f64 {
    let level = context.campaign.noise_level();
    let of_all = || context.misfit(fitted).ok()?.chance(level).ok();
    let known = context.campaign.noise.allows_verdict().then(of_all).flatten();
    let is_at_the_noise = last.is_some_and(StepReport::is_at_the_noise);
    known.unwrap_or(if is_at_the_noise { 1.0 } else { 0.0 })
}

/// `steps`: without the laws, and with them, at the ends.
fn report(
    number: usize,
    sum: &LawSum<'_>,
    probability: f64,
    fitted: &Fit,
    steps: &[StepReport],
    beside: usize,
) -> LawReport {
    let error = |step: &StepReport| step.error().times_noise();
    let ends = steps.first().zip(steps.last());
    LawReport {
        id: format!("law-{number}"),
        term: sum.id(),
        formula: sum.formula(),
        kind: sum.kind(),
        legs: sum.legs().into(),
        probability: probability.min(1.0),
        complexity: sum.complexity(),
        parameters: parameters(fitted, &steps.last().map(|s| s.terms[beside..].to_vec()).unwrap_or_default()),
        held_out: ends.map(|(before, after)| HeldOutFall { before: error(before), after: error(after) }),
        text: sum.sentence(),
        look_at: sum.look_at(),
        alike: Vec::new(),
    }
}

/// What is known of the numbers of these terms.
fn parameters(fitted: &Fit, ids: &[String]) -> Vec<Estimate> {
    let own = |e: &Estimate| {
        ids.iter().any(|id| e.name.strip_prefix(id.as_str()).is_some_and(|rest| rest.starts_with('.')))
    };
    estimates(fitted).determined.into_iter().filter(own).collect()
}

/// Laws that share the probability with another.
fn name_alike(reports: &mut [LawReport]) {
    let shares: Vec<String> =
        reports.iter().filter(|r| r.probability >= ALIKE).map(|r| r.id.clone()).collect();
    for report in reports.iter_mut().filter(|r| r.probability >= ALIKE) {
        report.alike = shares.iter().filter(|id| **id != report.id).cloned().collect();
    }
}
