//! Fits and errors beyond the search: steps, held-out data, rivals, what the springs absorb.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use hexbench_core::{Dataset, Hexapod};

use super::report::{AbsorbedReport, StepReport};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, average_over_shapes, fit};
use crate::estimation::foreseen::{Foreseen, Misfit, held_out_chance, held_out_misfit};
use crate::estimation::linearization::Linearization;
use crate::estimation::residuals::{held_out_gain, residuals, summarise};
use crate::inference::candidates::{Candidate, CandidateKind};
use crate::inference::diagnosis::RankedSets;
use crate::inference::explanation::Explanation;
use crate::inference::gain::{HeldOutGain, Worth};
use crate::inference::pattern::PatternVariable;
use crate::inference::search::Set;
use crate::inference::selection::{HeldOutErrors, JudgedTask};
use crate::inference::verdict::{Judgement, Verdict};
use crate::results::next::{
    Effort, ProposedReadings, RivalExplanation, RivalForm, candidate_readings, propose,
};

/// Errors on readings held out, and what the fits foresee of these.
type ErrorsForeseen = (HeldOutErrors, Vec<Foreseen>);

/// A model that predicts the holdout file worse than this chance allows is refuted.
const REFUTED_CHANCE: f64 = 1e-5;
/// A rival that predicts the holdout file at least this well is credible.
const SURVIVAL_CHANCE: f64 = 1e-3;
/// Held-out readings that are this probable under a model do not speak against it.
const NOTICED_CHANCE: f64 = 0.05;
/// Sets faced with the holdout file once the best one is refuted.
const SETS_FACED: usize = 40;
/// Candidates whose absorbed bias is worth a fit of their own.
const CANDIDATES_FITTED: usize = 4;
/// Explanations that the proposed readings separate.
pub(crate) const MOST_RIVALS: usize = 3;
/// Odds against the best explanation at which another still counts.
const LEAST_ODDS: f64 = 0.1;
/// Readings proposed at most.
const PROPOSALS: usize = 6;

pub(crate) struct Context<'a> {
    pub(crate) hexapod: &'a Hexapod,
    pub(crate) data: &'a Dataset,
    pub(crate) holdout: Option<&'a Dataset>,
    pub(crate) campaign: &'a Campaign,
    pub(crate) outcome: &'a RankedSets,
}

impl Context<'_> {
    /// Fit and errors of every prefix of the additions.
    pub(crate) fn steps(&self, order: &[TermSpec]) -> Result<(Vec<Fit>, Vec<StepReport>), ModelError> {
        self.steps_at(order, 0..=order.len())
    }

    /// The same of prefixes of so many additions each.
    pub(crate) fn steps_at(
        &self,
        order: &[TermSpec],
        counts: impl IntoIterator<Item = usize>,
    ) -> Result<(Vec<Fit>, Vec<StepReport>), ModelError> {
        let fit_of = |n: usize| {
            if n == 0 {
                return Ok((n, self.outcome.baseline.clone()));
            }
            let mut fitted = fit(self.campaign, &order[..n], Some(&self.outcome.best.point))?;
            average_over_shapes(self.campaign, &mut fitted)?;
            Ok((n, fitted))
        };
        let fits: Vec<(usize, Fit)> = counts.into_iter().map(fit_of).collect::<Result<_, ModelError>>()?;
        let last = fits.last().and_then(|(n, fitted)| self.held_out(&order[..*n], fitted));
        let all_terms = last.as_ref().map_or(&[][..], |(_, foreseen)| foreseen);
        let (mut steps, mut before) = (Vec::new(), None);
        for (k, (n, fitted)) in fits.iter().enumerate() {
            let is_last = k + 1 == fits.len();
            let own = if is_last { None } else { self.held_out(&order[..*n], fitted) };
            let after = if is_last { last.as_ref() } else { own.as_ref() };
            steps.push(self.step(&order[..*n], fitted, [before.as_ref(), after], all_terms)?);
            before = own;
        }
        Ok((fits.into_iter().map(|(_, fitted)| fitted).collect(), steps))
    }

    fn step(
        &self,
        terms: &[TermSpec],
        fitted: &Fit,
        [before, after]: [Option<&ErrorsForeseen>; 2],
        all_terms: &[Foreseen],
    ) -> Result<StepReport, ModelError> {
        let lin = Linearization::at(self.campaign, &fitted.point)?;
        let rows = residuals(self.campaign, &self.data.observations, |i| lin.residual(i));
        let both = before.zip(after);
        Ok(StepReport {
            terms: terms.iter().map(|w| w.term.info().id.to_owned()).collect(),
            fitted: summarise(&rows, Some(fitted.dof)),
            holdout: after.map(|(errors, _)| errors.summary),
            chance: after.and_then(|(errors, _)| errors.chance),
            gain: both.map(|((_, b), (_, a))| HeldOutGain::of(b, a)),
            worth: both.map(|((before, b), (after, a))| {
                let chi2 = [before, after].map(|errors| errors.summary.chi2_reduced);
                Worth::of([b, a, all_terms], chi2, after.summary.count)
            }),
        })
    }

    /// A sure answer whose predictions fail on the holdout file is not sure: everything that does survive there becomes
    /// credible. Something outside the catalogue must show there too, where it would.
    pub(super) fn face_holdout(&self, judgement: &mut Judgement, last: &Fit) {
        let Some(holdout) = self.holdout.filter(|_| self.campaign.noise.allows_verdict()) else { return };
        // Readings by which nothing can be foreseen refute nothing.
        let Ok(chance) = held_out_chance(self.campaign, holdout, last) else { return };
        if judgement.verdict == Verdict::Outside {
            if self.shows_nothing(holdout, (last, chance)) {
                judgement.withdraw_outside();
            }
            return;
        }
        if chance > REFUTED_CHANCE {
            if judgement.is_only_suspicious() && self.shows_nothing(holdout, (last, chance)) {
                judgement.verdict = Verdict::Named;
            }
            return;
        }
        judgement.verdict = Verdict::Ambiguous;
        judgement.refuted = true;
        let (outcome, start) = (self.outcome, &self.outcome.baseline.point);
        // Sets that differ in their patterns alone are one model.
        let mut faced: Vec<Vec<TermSpec>> = Vec::new();
        for set in outcome.sets.sets.iter().take(SETS_FACED) {
            let terms = outcome.wanted(set);
            if !faced.contains(&terms) {
                faced.push(terms);
            }
        }
        let survives =
            |fit: Fit| held_out_chance(self.campaign, holdout, &fit).is_ok_and(|p| p > SURVIVAL_CHANCE);
        let survived = parallel::map(&faced, |terms| {
            go_on();
            fit(self.campaign, terms, Some(start)).is_ok_and(survives)
        });
        let survivors =
            faced.iter().zip(survived).filter(|(_, survived)| *survived).flat_map(|(terms, _)| terms);
        for id in survivors.map(|w| w.term.info().id) {
            if !judgement.credible.iter().any(|c| c.is_term(id)) {
                judgement.credible.push(Explanation::Term(id.to_owned()));
            }
        }
    }

    /// True when nothing beyond the springs means something: there are readings to spare, their noise is known apart from what the
    /// springs leave, and some effect of its usual size would show.
    pub(super) fn can_judge(&self, last: &Fit) -> bool {
        let level = self.campaign.noise_level();
        let gram = &self.outcome.gram;
        let would_show = |c: &Candidate| {
            matches!(c.kind, CandidateKind::Term(_)) && c.blocks.iter().any(|&b| gram.blocks[b].noticeable)
        };
        last.lack_of_fit_dof > 0.0 && level.dof > 0.0 && self.outcome.candidates.iter().any(would_show)
    }

    /// Share of the error of all readings, noise included, that what is outside the catalogue makes up: what its pattern explains, or what
    /// the last fit leaves beyond the noise.
    pub(super) fn share_outside(&self, last: &Fit) -> f64 {
        let left = (last.lack_of_fit - last.lack_of_fit_dof).max(self.outcome.drop_by_patterns());
        let dof = last.dof.max(1.0);
        1.0 - (1.0 - (left / dof).clamp(0.0, 1.0)).sqrt()
    }

    /// True when the held-out readings are as the fit expects them, and the pattern found makes them no better predicted. They can deny no
    /// change between the lines of another file. `chance`: of what the fit leaves of them.
    fn shows_nothing(&self, holdout: &Dataset, (last, chance): (&Fit, f64)) -> bool {
        if self.outcome.simplest_pattern().is_some_and(|p| p.variable() == Some(PatternVariable::Line)) {
            return false;
        }
        chance > NOTICED_CHANCE && !self.pattern_predicts(holdout, last)
    }

    /// True when the most probable pattern makes held-out readings better predicted.
    fn pattern_predicts(&self, holdout: &Dataset, last: &Fit) -> bool {
        let pattern_of = |set: &Set| {
            set.members.iter().find_map(|&m| match &self.outcome.candidates[m].kind {
                CandidateKind::Pattern(pattern) => Some(*pattern),
                CandidateKind::Term(_) => None,
            })
        };
        let Some(pattern) = self.outcome.sets.sets.iter().find_map(pattern_of) else { return false };
        let Ok(here) = Linearization::at(self.campaign, &last.point) else { return false };
        let range = pattern.spread(&here.conditions);
        let block =
            |lin: &Linearization| lin.block_of(pattern.width(), |c, out| pattern.actions(c, range, out));
        held_out_gain(self.campaign, holdout, last, block).is_ok_and(|gain| gain > 0.0)
    }

    /// Errors on the holdout file, else on poses left out in turn.
    fn held_out(&self, terms: &[TermSpec], fitted: &Fit) -> Option<ErrorsForeseen> {
        let Self { hexapod, data, holdout, campaign, .. } = *self;
        let task = JudgedTask { hexapod, data, campaign, holdout };
        task.held_out_errors(fitted, Some(terms)).ok().flatten()
    }

    /// What a fit leaves of the readings fitted and, where a file of them is there, of those held out.
    pub(crate) fn misfit(&self, fitted: &Fit) -> Result<Misfit, ModelError> {
        let own = Misfit { chi2: fitted.lack_of_fit, numbers: fitted.lack_of_fit_dof };
        let Some(holdout) = self.holdout else { return Ok(own) };
        let held = held_out_misfit(self.campaign, holdout, fitted)?;
        Ok(Misfit { chi2: own.chi2 + held.chi2, numbers: own.numbers + held.numbers })
    }

    /// The most probable explanations, when none is sure.
    pub(super) fn rivals_of(&self, judgement: &Judgement) -> Vec<RivalExplanation> {
        if judgement.verdict == Verdict::Ambiguous { self.rivals() } else { Vec::new() }
    }

    /// Readings that separate explanations.
    pub(crate) fn proposed(&self, rivals: &[RivalExplanation]) -> ProposedReadings {
        let proposed = candidate_readings(self.campaign, rivals).and_then(|candidate_readings| {
            propose(self.campaign, rivals, &candidate_readings, Effort::UpTo(PROPOSALS))
        });
        proposed.unwrap_or_default()
    }

    /// Fit of the terms of a set.
    fn fit_of(&self, set: &Set) -> Option<Fit> {
        let terms = self.outcome.wanted(set);
        fit(self.campaign, &terms, Some(&self.outcome.best.point)).ok()
    }

    /// The best set of effects, others that are nearly as probable, and one at least that is not the same plus something more.
    fn rivals(&self) -> Vec<RivalExplanation> {
        let outcome = self.outcome;
        let is_named = |s: &&Set| {
            s.members.iter().all(|&m| matches!(outcome.candidates[m].kind, CandidateKind::Term(_)))
        };
        let named: Vec<&Set> = outcome.sets.sets.iter().filter(is_named).collect();
        let Some(&best) = named.first() else { return Vec::new() };
        let contains = |big: &Set, small: &Set| small.members.iter().all(|m| big.members.contains(m));
        let other = named.iter().position(|s| !contains(s, best) && !contains(best, s));
        let probable = |s: &Set| s.log_weight > best.log_weight + LEAST_ODDS.ln();
        let chosen = named.iter().enumerate().filter(|(k, s)| Some(*k) == other || probable(s));
        let mut sets: Vec<&Set> = chosen.map(|(_, s)| *s).collect();
        // A rival of another kind must not be crowded out by additions to the best set.
        sets.sort_by_key(|s| s.members != best.members && contains(s, best));
        let explanation = |s: &&Set| {
            let ids =
                s.members.iter().filter_map(|&m| outcome.candidates[m].id().map(str::to_owned)).collect();
            let (weight, fit) = (outcome.sets.probability(s), self.fit_of(s)?);
            let forms = RivalForm::left_open(self.campaign, s, outcome);
            Some(RivalExplanation { terms: ids, weight, fit, forms })
        };
        sets.iter().filter_map(explanation).take(MOST_RIVALS).collect()
    }

    /// Bias of the stiffnesses without each added term, and without the strongest other candidates.
    pub(super) fn absorbed(&self, order: &[TermSpec], judgement: &Judgement) -> Vec<AbsorbedReport> {
        let mut all = Vec::new();
        let with = &self.outcome.best;
        for (k, w) in order.iter().enumerate() {
            let mut others = order.to_vec();
            others.remove(k);
            if let Ok(without) = fit(self.campaign, &others, Some(&with.point)) {
                all.push(absorbed(w.term.info().id, &without, with));
            }
        }
        let known: Vec<String> = all.iter().map(|a| a.term.clone()).collect();
        let likely = judgement.first.iter().filter(|(_, p)| *p > 0.01).map(|(e, _)| e);
        let rest = likely.filter(|e| !known.iter().any(|id| e.is_term(id)));
        for id in rest.take(CANDIDATES_FITTED).filter_map(Explanation::term) {
            let single =
                |s: &&Set| s.members.len() == 1 && self.outcome.candidates[s.members[0]].id() == Some(id);
            let Some(set) = self.outcome.sets.sets.iter().find(single) else { continue };
            let terms = self.outcome.wanted(set);
            if let Ok(with) = fit(self.campaign, &terms, Some(&self.outcome.baseline.point)) {
                all.push(absorbed(id, &self.outcome.baseline, &with));
            }
        }
        all
    }
}

fn absorbed(id: &str, without: &Fit, with: &Fit) -> AbsorbedReport {
    let bias = |leg: usize| {
        let determined = with.is_determined(leg) && without.is_determined(leg);
        let ratio = with.point.compliances[leg] / without.point.compliances[leg];
        (determined && ratio.is_finite()).then_some(100.0 * (ratio - 1.0))
    };
    AbsorbedReport { term: id.to_owned(), bias_of_leg_stiffness_percent: std::array::from_fn(bias) }
}
