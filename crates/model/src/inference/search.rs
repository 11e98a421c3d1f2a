//! Search over sets of effects, and the posterior probability of each set.
//!
//! Sets grow one effect at a time from the best sets so far; within a set every effect takes its best form, shape and
//! prior width, and its evidence is averaged over them. Each set is also weighed with an unexplained discrepancy of
//! unknown size on top (noise of the averaged readings inflated), which is what "none of the effects I know" means.

use std::collections::BTreeMap;

use crate::inference::candidates::{Candidate, CandidateKind};
use crate::inference::evidence::{Gram, Variant, log_sum};

/// Prior probability of no, one, two, three and four effects.
const PRIOR_OF_COUNT: [f64; 5] = [0.45, 0.38, 0.13, 0.03, 0.01];
/// Prior probability of a discrepancy that no candidate describes.
pub(crate) const PRIOR_OF_DISCREPANCY: f64 = 0.03;
/// Variance inflation factors the discrepancy is averaged over; what adds less than 5 % to the error is not worth a verdict.
const INFLATIONS: [f64; 8] = [1.1, 1.2, 1.4, 2.0, 4.0, 10.0, 100.0, 1e4];
/// Sets grown further in each round.
const BEAM: usize = 4;
/// Sets stop growing once the best of the next size is this many nats below the best.
const GIVEN_UP: f64 = 2.0;
/// Best sets that are also weighed with a discrepancy.
const DISCREPANT_SETS: usize = 24;

/// A set of candidates with its evidence.
#[derive(Debug, Clone)]
pub struct Set {
    /// Indices of the candidates, ascending.
    pub members: Vec<usize>,
    /// Best form, shape and width of each member.
    pub variants: Vec<Variant>,
    /// Log-evidence averaged over forms, shapes and widths, plus log-prior; relative to nothing.
    pub log_weight: f64,
    /// The same with a discrepancy on top.
    pub log_weight_discrepant: f64,
    /// Drop of chi-square.
    pub drop: f64,
    /// What averaging over forms, shapes and widths adds to the evidence of the chosen ones.
    bonus: f64,
}

impl Set {
    /// The same set with other weights, without and with a discrepancy.
    pub(crate) fn weighing(&self, log_weight: f64, log_weight_discrepant: f64) -> Self {
        Self { log_weight, log_weight_discrepant, ..self.clone() }
    }

    /// The same set with another variant of one of its members.
    pub(crate) fn in_form(&self, member: usize, variant: Variant) -> Self {
        let mut other = self.clone();
        other.variants[member] = variant;
        other
    }
}

/// All sets looked at, best first.
#[derive(Debug, Clone)]
pub struct Sets {
    /// Sets with their evidence.
    pub sets: Vec<Set>,
    /// Logarithm of the summed weight of all sets, discrepant or not.
    pub log_total: f64,
}

impl Sets {
    /// Best first.
    fn of(mut sets: Vec<Set>) -> Self {
        sort(&mut sets);
        let weights: Vec<f64> = sets.iter().flat_map(|s| [s.log_weight, s.log_weight_discrepant]).collect();
        Self { log_total: log_sum(weights.iter().copied()), sets }
    }

    /// The same with some of them weighed anew.
    pub(crate) fn with(self, anew: impl Iterator<Item = Set>) -> Self {
        let mut sets = self.sets;
        for set in anew {
            if let Some(known) = sets.iter_mut().find(|s| s.members == set.members) {
                *known = set;
            }
        }
        Self::of(sets)
    }

    /// Probability of a set without discrepancy.
    pub fn probability(&self, set: &Set) -> f64 {
        (set.log_weight - self.log_total).exp()
    }

    /// Probability of a discrepancy, whatever else there is.
    pub fn outside(&self) -> f64 {
        self.sets.iter().map(|set| self.discrepant_probability(set)).sum()
    }

    /// Probability of a set with a discrepancy on top.
    pub fn discrepant_probability(&self, set: &Set) -> f64 {
        (set.log_weight_discrepant - self.log_total).exp()
    }
}

/// The search.
pub struct TermSearch<'a> {
    gram: &'a Gram,
    candidates: &'a [Candidate],
    effects: f64,
    discrepancy: bool,
    done: BTreeMap<Vec<usize>, Set>,
}

impl<'a> TermSearch<'a> {
    /// Prepare; `discrepancy` is possible where the noise level is known independently of the model.
    pub fn new(gram: &'a Gram, candidates: &'a [Candidate], discrepancy: bool) -> Self {
        Self { gram, candidates, effects: effects(candidates), discrepancy, done: BTreeMap::new() }
    }

    /// The same for some of these candidates: the others count in the prior, as if they had been looked at.
    #[must_use]
    pub fn among(self, all: &[Candidate]) -> Self {
        Self { effects: effects(all), ..self }
    }

    /// Search from nothing up to `most` effects.
    pub fn run(mut self, most: usize) -> Sets {
        self.record(Vec::new(), Vec::new(), 0.0);
        for size in 0..most.min(PRIOR_OF_COUNT.len() - 1) {
            let before = self.best_weight();
            for parent in self.best_of_size(size) {
                self.grow(&parent);
            }
            for child in self.best_of_size(size + 1) {
                self.polish(&child);
            }
            if size >= 1
                && self.best_of_size(size + 1).first().is_none_or(|s| s.log_weight < before - GIVEN_UP)
            {
                break;
            }
        }
        self.finish()
    }

    /// Every extension of a set by one candidate, beside the variants the set has.
    fn grow(&mut self, parent: &Set) {
        for (index, candidate) in self.candidates.iter().enumerate() {
            if parent.members.contains(&index) {
                continue;
            }
            let profile = self.gram.profile(&parent.variants, &candidate.blocks);
            let Some(&(variant, _)) = profile.first() else { continue };
            let bonus = parent.bonus + self.bonus(&profile, variant);
            let place = parent.members.partition_point(|&m| m < index);
            let (mut members, mut variants) = (parent.members.clone(), parent.variants.clone());
            members.insert(place, index);
            variants.insert(place, variant);
            self.record(members, variants, bonus);
        }
    }

    /// One round of coordinate ascent over the variants of each member, and the exact average over them.
    fn polish(&mut self, set: &Set) {
        let mut variants = set.variants.clone();
        let mut bonus = 0.0;
        for (k, &m) in set.members.iter().enumerate() {
            let mut others = variants.clone();
            others.remove(k);
            let profile = self.gram.profile(&others, &self.candidates[m].blocks);
            if let Some(&(v, _)) = profile.first() {
                variants[k] = v;
                bonus += self.bonus(&profile, v);
            }
        }
        self.done.remove(&set.members);
        self.record(set.members.clone(), variants, bonus);
    }

    /// What averaging over the variants of one member adds to the evidence of the chosen one.
    fn bonus(&self, profile: &[(Variant, f64)], chosen: Variant) -> f64 {
        let at_chosen = profile.iter().find(|p| p.0 == chosen).map_or(0.0, |p| p.1);
        let block = &self.gram.blocks[chosen.block];
        let share = block.log_share - (block.widths.len() as f64).ln();
        log_sum(profile.iter().map(|p| p.1)) - at_chosen + share
    }

    /// Note a set; of two ways to the same set the better one stays.
    fn record(&mut self, members: Vec<usize>, variants: Vec<Variant>, bonus: f64) {
        let Some(posterior) = self.gram.posterior(&variants, 1.0) else { return };
        let white = if self.discrepancy { (1.0 - PRIOR_OF_DISCREPANCY).ln() } else { 0.0 };
        let log_weight = posterior.log_evidence + bonus + self.log_prior(&members) + white;
        if self.done.get(&members).is_some_and(|known| known.log_weight >= log_weight) {
            return;
        }
        let log_weight_discrepant = f64::NEG_INFINITY;
        let drop = posterior.drop;
        self.done.insert(
            members.clone(),
            Set { members, variants, log_weight, log_weight_discrepant, drop, bonus },
        );
    }

    /// Weight of a set with a discrepancy of unknown size on top.
    fn discrepant(&self, set: &Set) -> f64 {
        let Some(white) = self.gram.posterior(&set.variants, 1.0) else { return f64::NEG_INFINITY };
        let gains = INFLATIONS.map(|s| {
            let inflated = self.gram.posterior(&set.variants, s);
            inflated.map_or(f64::NEG_INFINITY, |p| p.log_evidence - white.log_evidence)
        });
        let odds = PRIOR_OF_DISCREPANCY / (1.0 - PRIOR_OF_DISCREPANCY) / INFLATIONS.len() as f64;
        set.log_weight + odds.ln() + log_sum(gains.into_iter())
    }

    /// Prior of a set: of its size, shared among the sets of that size, times the weights of its members.
    fn log_prior(&self, members: &[usize]) -> f64 {
        let k = members.len();
        let choices: f64 = (0..k).map(|i| ((self.effects - i as f64).max(1.0) / (i + 1) as f64).ln()).sum();
        let weights: f64 = members.iter().map(|&m| self.candidates[m].log_weight).sum();
        PRIOR_OF_COUNT[k.min(PRIOR_OF_COUNT.len() - 1)].ln() - choices + weights
    }

    fn best_of_size(&self, size: usize) -> Vec<Set> {
        let mut sets: Vec<Set> = self.done.values().filter(|s| s.members.len() == size).cloned().collect();
        sort(&mut sets);
        sets.truncate(BEAM);
        sets
    }

    fn best_weight(&self) -> f64 {
        self.done.values().map(|s| s.log_weight).fold(f64::NEG_INFINITY, f64::max)
    }

    fn finish(self) -> Sets {
        let mut sets: Vec<Set> = self.done.values().cloned().collect();
        sort(&mut sets);
        if self.discrepancy {
            for set in sets.iter_mut().take(DISCREPANT_SETS) {
                set.log_weight_discrepant = self.discrepant(set);
            }
        }
        Sets::of(sets)
    }
}

/// Logarithm of the odds before the readings of one effect more beside so many, over none.
pub(crate) fn log_odds_of_one_more(candidates: &[Candidate], beside: usize) -> f64 {
    let prior = |count: usize| PRIOR_OF_COUNT[count.min(PRIOR_OF_COUNT.len() - 1)].ln();
    let choices = (effects(candidates) - beside as f64).max(1.0) / (beside + 1) as f64;
    prior(beside + 1) - prior(beside) - choices.ln()
}

/// Effects that share the prior; the patterns together count as one more.
fn effects(candidates: &[Candidate]) -> f64 {
    (candidates.iter().filter(|c| matches!(c.kind, CandidateKind::Term(_))).count() + 1) as f64
}

fn sort(sets: &mut [Set]) {
    sets.sort_by(|a, b| b.log_weight.total_cmp(&a.log_weight).then(a.members.cmp(&b.members)));
}

#[cfg(test)]
impl Set {
    /// A set of so much weight, without and with a discrepancy.
    pub(crate) fn of_weights(members: &[usize], log_weight: f64, log_weight_discrepant: f64) -> Self {
        let (members, variants) = (members.to_vec(), Vec::new());
        Self { members, variants, log_weight, log_weight_discrepant, drop: 0.0, bonus: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terms::catalogue;

    #[test]
    fn without_readings_everything_is_as_probable_as_before() {
        let gram = Gram::unseen(3);
        let terms: Vec<_> = catalogue().into_iter().take(3).collect();
        let candidates: Vec<Candidate> =
            terms.iter().enumerate().map(|(k, term)| Candidate::of_block(term, k)).collect();
        let found = TermSearch::new(&gram, &candidates, true).run(4);
        let probability = |set: &Set| found.probability(set) + found.discrepant_probability(set);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        assert!(close(found.sets.iter().map(probability).sum(), 1.0));
        let discrepant: f64 = found.sets.iter().map(|set| found.discrepant_probability(set)).sum();
        assert!(close(discrepant, 0.03), "{discrepant}");
        // The three effects and all patterns share the prior of their number: four singles, six pairs. Three are given up.
        let none = found.sets.iter().find(|set| set.members.is_empty()).unwrap();
        for (size, sets, odds) in [(1, 3, 0.38 / 4.0 / 0.45), (2, 3, 0.13 / 6.0 / 0.45), (3, 0, 0.0)] {
            let alike: Vec<&Set> = found.sets.iter().filter(|set| set.members.len() == size).collect();
            assert_eq!(alike.len(), sets, "{size}");
            assert!(alike.iter().all(|set| close(probability(set) / probability(none), odds)), "{size}");
        }
        let sure = TermSearch::new(&gram, &candidates, false).run(0);
        assert!(close(sure.probability(&sure.sets[0]), 1.0));
    }
}
