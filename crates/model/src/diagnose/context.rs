//! Fits and errors beyond the search: steps, held-out data, rivals, what the springs absorb.

use hexbench_core::{Dataset, Hexapod};

use super::report::{AbsorbedReport, NextReport, StepReport};
use crate::campaign::Campaign;
use crate::candidates::Kind;
use crate::diagnosis::{Outcome, wanted};
use crate::error::ModelError;
use crate::fit::{Fit, Wanted, average_over_shapes, fit};
use crate::linearization::Linearization;
use crate::next::{Proposal, separate};
use crate::residuals::{Residual, leave_poses_out, prediction_errors, residuals, summarise, survival};
use crate::search::Set;
use crate::verdict::{Judgement, NONE, OUTSIDE, Verdict};

/// A model that predicts the holdout file worse than this chance allows is refuted.
const REFUTED_CHANCE: f64 = 1e-5;
/// A rival that predicts the holdout file at least this well is credible.
const SURVIVAL_CHANCE: f64 = 1e-3;
/// Sets faced with the holdout file once the best one is refuted.
const SETS_FACED: usize = 40;
/// Candidates whose absorbed bias is worth a fit of their own.
const CANDIDATES_FITTED: usize = 4;

pub(super) struct Context<'a> {
    pub(super) hexapod: &'a Hexapod,
    pub(super) data: &'a Dataset,
    pub(super) holdout: Option<&'a Dataset>,
    pub(super) campaign: &'a Campaign,
    pub(super) outcome: &'a Outcome,
}

impl Context<'_> {
    /// Fit and errors of every prefix of the additions.
    pub(super) fn steps(&self, order: &[Wanted]) -> Result<(Vec<Fit>, Vec<StepReport>), ModelError> {
        let (mut fits, mut steps) = (Vec::new(), Vec::new());
        for n in 0..=order.len() {
            let fitted = if n == 0 {
                self.outcome.baseline.clone()
            } else {
                let mut fitted = fit(self.campaign, &order[..n], Some(&self.outcome.best.point))?;
                average_over_shapes(self.campaign, &order[..n], &mut fitted)?;
                fitted
            };
            let rows = residuals(
                self.campaign,
                &self.data.observations,
                &Linearization::at(self.campaign, &fitted.point)?,
            );
            steps.push(StepReport {
                terms: order[..n].iter().map(|w| w.term.info().id.to_owned()).collect(),
                fitted: summarise(&rows, Some(fitted.dof)),
                holdout: self.held_out(&order[..n], &fitted).map(|r| summarise(&r, None)),
            });
            fits.push(fitted);
        }
        Ok((fits, steps))
    }

    /// A sure answer whose predictions fail on the holdout file is not sure: everything that does survive there becomes
    /// credible.
    pub(super) fn face_holdout(&self, judgement: &mut Judgement, last: &Fit) {
        let Some(holdout) = self.holdout.filter(|_| judgement.verdict != Verdict::Outside) else { return };
        let noise = self.campaign.noise;
        if !noise.allows_verdict() {
            return;
        }
        let survives =
            |fit: &Fit, chance: f64| survival(self.hexapod, holdout, noise, fit).is_ok_and(|p| p > chance);
        if survives(last, REFUTED_CHANCE) {
            return;
        }
        judgement.verdict = Verdict::Ambiguous;
        judgement.refuted = true;
        let start = &self.outcome.baseline.point;
        for set in self.outcome.sets.sets.iter().take(SETS_FACED) {
            let terms = wanted(set, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
            if fit(self.campaign, &terms, Some(start)).is_ok_and(|f| survives(&f, SURVIVAL_CHANCE)) {
                for id in terms.iter().map(|w| w.term.info().id) {
                    if !judgement.credible.iter().any(|c| c == id) {
                        judgement.credible.push(id.to_owned());
                    }
                }
            }
        }
    }

    fn held_out(&self, terms: &[Wanted], fitted: &Fit) -> Option<Vec<Residual>> {
        let noise = self.campaign.noise;
        match self.holdout {
            Some(holdout) => prediction_errors(self.hexapod, holdout, noise, &fitted.point).ok(),
            None => leave_poses_out(self.hexapod, self.data, noise, terms, &fitted.point).ok(),
        }
    }

    /// Readings that separate the two most probable explanations, when none is sure.
    pub(super) fn next(&self, judgement: &Judgement) -> Vec<NextReport> {
        if judgement.verdict != Verdict::Ambiguous {
            return Vec::new();
        }
        let Some((a, b)) = self.rivals() else { return Vec::new() };
        let (Some(fit_a), Some(fit_b)) = (self.fit_of(a), self.fit_of(b)) else { return Vec::new() };
        let names = [self.name(a, b), self.name(b, a)];
        let proposals = separate(self.campaign, &fit_a, &fit_b).unwrap_or_default();
        proposals.iter().map(|p| next_report(p, &names, self.breaker(a, b))).collect()
    }

    /// Fit of the terms of a set.
    pub(super) fn fit_of(&self, set: &Set) -> Option<Fit> {
        let terms = wanted(set, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
        fit(self.campaign, &terms, Some(&self.outcome.best.point)).ok()
    }

    /// The best set and the best set that is not merely the same plus something more.
    fn rivals(&self) -> Option<(&Set, &Set)> {
        let sets = &self.outcome.sets.sets;
        let best = sets.first()?;
        let contains = |big: &Set, small: &Set| small.members.iter().all(|m| big.members.contains(m));
        let rival = sets.iter().skip(1).find(|s| !contains(s, best) && !contains(best, s));
        Some((best, rival.or_else(|| sets.get(1))?))
    }

    /// What a set has that the other has not.
    fn name(&self, set: &Set, other: &Set) -> String {
        let own = set.members.iter().filter(|m| !other.members.contains(m));
        let names: Vec<&str> = own.map(|&m| self.outcome.candidates[m].id().unwrap_or(OUTSIDE)).collect();
        if names.is_empty() { NONE.to_owned() } else { names.join(" + ") }
    }

    fn breaker(&self, a: &Set, b: &Set) -> String {
        let own = a.members.iter().filter(|m| !b.members.contains(m));
        let terms = own.filter_map(|&m| match &self.outcome.candidates[m].kind {
            Kind::Term(t) => Some(t.info().breaker),
            Kind::Pattern(_) => None,
        });
        terms.collect::<Vec<_>>().join("; ")
    }

    /// Bias of the stiffnesses without each added term, and without the strongest other candidates.
    pub(super) fn absorbed(&self, order: &[Wanted], judgement: &Judgement) -> Vec<AbsorbedReport> {
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
        let rest = judgement.first.iter().filter(|(id, p)| *p > 0.01 && !known.contains(id));
        for (id, _) in rest.take(CANDIDATES_FITTED) {
            let single =
                |s: &&Set| s.members.len() == 1 && self.outcome.candidates[s.members[0]].id() == Some(id);
            let Some(set) = self.outcome.sets.sets.iter().find(single) else { continue };
            let terms = wanted(set, &self.outcome.gram, &self.outcome.candidates, &self.outcome.natural);
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
        let ratio = with.point.springs[leg] / without.point.springs[leg];
        (determined && ratio.is_finite()).then_some(100.0 * (ratio - 1.0))
    };
    AbsorbedReport { term: id.to_owned(), bias_of_leg_stiffness_percent: std::array::from_fn(bias) }
}

fn next_report(p: &Proposal, separates: &[String; 2], breaker: String) -> NextReport {
    let o = &p.observation;
    let pose = o.pose.to_array();
    NextReport {
        pose: std::array::from_fn(|k| if k < 3 { pose[k] * 1e3 } else { pose[k].to_degrees() }),
        wrench: o.wrench.to_array(),
        reference: o.reference.to_array(),
        approach: o.approach,
        elapsed_s: o.elapsed,
        separates: separates.clone(),
        gain: p.gain,
        text: breaker,
    }
}
