//! From sets with laws to what is said of them.

use std::collections::BTreeMap;

use hexbench_core::Dataset;

use super::Reason;
use super::report::{Discovery, HeldOutFall, LawReport};
use crate::error::ModelError;
use crate::estimation::estimate::{Estimate, estimates};
use crate::estimation::fit::{Fit, TermSpec};
use crate::estimation::linearization::Linearization;
use crate::inference::diagnosis::{RankedSets, wanted};
use crate::inference::discovery::LawTerm;
use crate::inference::search::Set;
use crate::inference::verdict::{NAMED, Verdict};
use crate::results::diagnose::{Context, Diagnosis, StepReport};

/// Laws told.
const MOST_TOLD: usize = 5;
/// Ideas told where no law convinces.
const IDEAS: usize = 3;
/// Probability above which a law counts as one that these readings do not tell from the best.
const ALIKE: f64 = 0.02;
/// Share of the excess over the noise that a law has to take off the held-out error, at least.
const MOST_OF_IT: f64 = 0.9;

/// What is said of the laws.
pub(super) struct Judged {
    reason: Reason,
    text: String,
    beside: Vec<String>,
    laws: Vec<LawReport>,
    /// Index of the best law, and its sizes and constant.
    best: Option<(usize, Vec<f64>, f64)>,
    steps: Vec<StepReport>,
    pub(super) fits: Vec<Fit>,
    probability: f64,
}

/// Weights of sets summed over what they contain.
struct Weights {
    /// Probability that a law is at work.
    of_laws: f64,
    /// The same of each law.
    of_law: BTreeMap<&'static str, f64>,
    /// Probability of each effect of the catalogue.
    of_effect: BTreeMap<&'static str, f64>,
    /// Probability of a discrepancy that nothing describes.
    discrepant: f64,
}

impl Judged {
    pub(super) fn of(
        context: &Context<'_>,
        laws: &[LawTerm],
        diagnosis: &Diagnosis,
    ) -> Result<Self, ModelError> {
        let outcome = context.outcome;
        let weights = Weights::of(outcome, laws);
        let best = best_with_law(outcome, laws);
        let Some(best) = best else { return Ok(Self::without(context, diagnosis, weights.of_laws)) };
        let order = order(best, outcome, laws, &weights);
        let (fits, steps) = context.steps(&order)?;
        let is_law = |id: &str| laws.iter().any(|l| l.term.info().id == id);
        let beside: Vec<String> =
            order.iter().map(|w| w.term.info().id).filter(|id| !is_law(id)).map(str::to_owned).collect();
        let convinces = weights.of_laws >= NAMED && survives(&steps, beside.len(), weights.of_laws);
        let told = told(context, laws, &weights, best, &order)?;
        if !convinces {
            return Ok(Self {
                laws: told.0,
                best: told.1,
                ..Self::without(context, diagnosis, weights.of_laws)
            });
        }
        let text = told.0.first().map(|l| l.text.clone()).unwrap_or_default();
        Ok(Self {
            reason: Reason::Law,
            text,
            beside,
            laws: told.0,
            best: told.1,
            steps,
            fits,
            probability: weights.of_laws,
        })
    }

    /// No law convinces: what the catalogue says stands.
    fn without(context: &Context<'_>, diagnosis: &Diagnosis, probability: f64) -> Self {
        let last = diagnosis.steps.last();
        let explained =
            last.is_some_and(StepReport::is_at_the_noise) && diagnosis.verdict != Verdict::Outside;
        let (reason, text) = if explained && !diagnosis.added.is_empty() {
            (Reason::Catalogue, format!("the catalogue explains it: {}", diagnosis.added.join(" and ")))
        } else if explained {
            (
                Reason::Catalogue,
                "several explanations of the catalogue remain, and each explains the readings".to_owned(),
            )
        } else {
            (
                Reason::NoLawConvinces,
                "something is missing, and no law of those searched convinces".to_owned(),
            )
        };
        Self {
            reason,
            text,
            beside: diagnosis.added.clone(),
            laws: Vec::new(),
            best: None,
            steps: diagnosis.steps.clone(),
            fits: vec![context.outcome.baseline.clone()],
            probability,
        }
    }

    /// The best law as a term file.
    pub(super) fn term_file(&self, laws: &[LawTerm], lin: &Linearization, data: &Dataset) -> Option<String> {
        let (index, sizes, constant) = self.best.as_ref()?;
        let report = self.laws.first()?;
        let sizes_told = report
            .parameters
            .iter()
            .map(|p| format!("{} = {:.4} +- {:.2} {}", p.name, p.value, p.std, p.unit));
        let mut source = vec![
            format!(
                "Found by hexbench {} in {}, {} readings",
                env!("CARGO_PKG_VERSION"),
                data.source,
                data.observations.len()
            ),
            format!("probability {:.3}", report.probability),
        ];
        source.extend(
            report
                .held_out
                .map(|h| format!("held-out error {:.2} -> {:.2} times the noise", h.before, h.after)),
        );
        source.extend(sizes_told);
        Some(laws[*index].file(lin, sizes, *constant, &source))
    }

    pub(super) fn report(&self, verdict: Verdict, searched: usize) -> Discovery {
        let found = self.reason == Reason::Law;
        let mut laws = self.laws.clone();
        if !found {
            laws.truncate(IDEAS);
        }
        Discovery {
            format: "discovery/1",
            found,
            reason: self.reason,
            text: self.text.clone(),
            verdict,
            beside: self.beside.clone(),
            laws,
            steps: self.steps.clone(),
            probability: self.probability,
            searched,
            warnings: Vec::new(),
        }
    }
}

impl Weights {
    fn of(outcome: &RankedSets, laws: &[LawTerm]) -> Self {
        let mut weights =
            Self { of_laws: 0.0, of_law: BTreeMap::new(), of_effect: BTreeMap::new(), discrepant: 0.0 };
        for set in &outcome.sets.sets {
            let discrepant = outcome.sets.discrepant_probability(set);
            let all = outcome.sets.probability(set) + discrepant;
            weights.discrepant += discrepant;
            if has_law(set, outcome, laws) {
                weights.of_laws += all;
            }
            for id in set.members.iter().filter_map(|&m| outcome.candidates[m].id()) {
                let place =
                    if index_of(id, laws).is_some() { &mut weights.of_law } else { &mut weights.of_effect };
                *place.entry(id).or_default() += all;
            }
        }
        weights.of_laws = weights.of_laws.min(1.0);
        weights
    }
}

fn index_of(id: &str, laws: &[LawTerm]) -> Option<usize> {
    laws.iter().position(|l| l.term.info().id == id)
}

fn has_law(set: &Set, outcome: &RankedSets, laws: &[LawTerm]) -> bool {
    set.members.iter().any(|&m| outcome.candidates[m].id().is_some_and(|id| index_of(id, laws).is_some()))
}

fn best_with_law<'a>(outcome: &'a RankedSets, laws: &[LawTerm]) -> Option<&'a Set> {
    outcome.sets.sets.iter().find(|s| has_law(s, outcome, laws))
}

/// Terms of a set: effects of the catalogue that are sure, then laws.
fn order(set: &Set, outcome: &RankedSets, laws: &[LawTerm], weights: &Weights) -> Vec<TermSpec> {
    let all = wanted(set, &outcome.gram, &outcome.candidates, &outcome.natural);
    let is_law = |w: &TermSpec| index_of(w.term.info().id, laws).is_some();
    let is_sure = |w: &TermSpec| weights.of_effect.get(w.term.info().id).is_some_and(|p| *p >= NAMED);
    let mut order: Vec<TermSpec> = all.into_iter().filter(|w| is_law(w) || is_sure(w)).collect();
    order.sort_by_key(is_law);
    order
}

/// True when held-out poses agree with every law, and the laws take most of what was left.
fn survives(steps: &[StepReport], beside: usize, probability: f64) -> bool {
    let of_laws = &steps[(beside + 1).min(steps.len())..];
    let agree = of_laws.iter().all(|step| {
        step.gain.is_none_or(|gain| gain.leaves_sure(probability))
            && step.worth.is_none_or(|worth| !worth.is_small())
    });
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else { return false };
    let excess = |step: &StepReport| (step.error().chi2_reduced - 1.0).max(0.0);
    let taken = 1.0 - excess(last) / excess(first).max(f64::MIN_POSITIVE);
    agree && (last.is_at_the_noise() || taken >= MOST_OF_IT)
}

type Told = (Vec<LawReport>, Option<(usize, Vec<f64>, f64)>);

/// The laws that are told, best first, each fitted in the place of the best one.
fn told(
    context: &Context<'_>,
    laws: &[LawTerm],
    weights: &Weights,
    best: &Set,
    order: &[TermSpec],
) -> Result<Told, ModelError> {
    let outcome = context.outcome;
    let leader =
        best.members.iter().filter_map(|&m| outcome.candidates[m].id()).find_map(|id| index_of(id, laws));
    let probability = |k: usize| weights.of_law.get(laws[k].term.info().id).copied().unwrap_or(0.0);
    let mut ranked: Vec<usize> = (0..laws.len()).collect();
    ranked.sort_by(|&a, &b| {
        let first = |k: usize| Some(k) != leader;
        first(a)
            .cmp(&first(b))
            .then(probability(b).total_cmp(&probability(a)))
            .then(laws[b].score.total_cmp(&laws[a].score))
    });
    let rest: Vec<TermSpec> =
        order.iter().filter(|w| index_of(w.term.info().id, laws).is_none()).cloned().collect();
    let (mut reports, mut values) = (Vec::new(), None);
    for (rank, &k) in ranked.iter().take(MOST_TOLD).enumerate() {
        let mine = if Some(k) == leader { order.to_vec() } else { with(&rest, &laws[k], outcome) };
        let Ok((fits, steps)) = context.steps(&mine) else { continue };
        let Some(fitted) = fits.last() else { continue };
        let id = laws[k].term.info().id;
        let Some(active) = fitted.point.active.iter().find(|a| a.id() == id) else { continue };
        if rank == 0 {
            values = Some((k, active.values.clone(), active.shape));
        }
        let at = mine.iter().position(|w| w.term.info().id == id).unwrap_or(0);
        let error = |step: &StepReport| step.error().times_noise();
        reports.push(LawReport {
            id: format!("law-{}", reports.len() + 1),
            term: id.to_owned(),
            formula: laws[k].formula(),
            kind: "elongation",
            legs: laws[k].legs().numbers().into(),
            probability: probability(k).min(1.0),
            complexity: laws[k].complexity(),
            parameters: parameters(fitted, id),
            held_out: Some(HeldOutFall { before: error(&steps[at]), after: error(&steps[at + 1]) }),
            text: laws[k].sentence(&active.values, active.shape),
            look_at: laws[k].look_at(),
            alike: Vec::new(),
        });
    }
    name_alike(&mut reports);
    Ok((reports, values))
}

/// Laws that share the probability with another.
fn name_alike(reports: &mut [LawReport]) {
    let shares: Vec<String> =
        reports.iter().filter(|r| r.probability >= ALIKE).map(|r| r.id.clone()).collect();
    for report in reports.iter_mut().filter(|r| r.probability >= ALIKE) {
        report.alike = shares.iter().filter(|id| **id != report.id).cloned().collect();
    }
}

/// Effects with a law in its best form.
fn with(rest: &[TermSpec], law: &LawTerm, outcome: &RankedSets) -> Vec<TermSpec> {
    let id = law.term.info().id;
    let single = outcome
        .sets
        .sets
        .iter()
        .find(|s| s.members.len() == 1 && outcome.candidates[s.members[0]].id() == Some(id));
    let own =
        single.map(|s| wanted(s, &outcome.gram, &outcome.candidates, &outcome.natural)).unwrap_or_default();
    rest.iter().cloned().chain(own).collect()
}

/// What is known of the numbers of a term.
fn parameters(fitted: &Fit, id: &str) -> Vec<Estimate> {
    let own = |e: &Estimate| e.name.strip_prefix(id).is_some_and(|rest| rest.starts_with('.'));
    estimates(fitted).determined.into_iter().filter(own).collect()
}
