//! From probabilities of sets to a verdict.

use std::collections::BTreeMap;

use crate::inference::candidates::{Candidate, CandidateKind};
use crate::inference::explanation::Explanation;
use crate::inference::search::{Set, Sets};

/// Probability an effect must have to be named.
pub const NAMED: f64 = 0.95;
/// Probability of any further effect above which a named set is not the whole answer.
pub const DOUBT: f64 = 0.5;
/// Probability of something outside the catalogue beside sure effects, above which they are not the whole answer; before any readings
/// it is 3 %.
const SUSPICION: f64 = 0.1;
/// Share of probability a credible set holds.
const CREDIBLE: f64 = 0.95;

/// What the data say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The springs explain the data to within the noise.
    Adequate,
    /// The named effects explain the data.
    Named,
    /// Several explanations remain.
    Ambiguous,
    /// Something outside the catalogue is at work.
    Outside,
    /// What is wrong is in the data: without it the springs explain them.
    Measurement,
    /// These readings cannot judge: too few of them, no noise level, or no effect of its usual size would show.
    Undecided,
}

hexbench_core::worded! {
    /// One word, as in the files.
    Verdict::word {
        Adequate => "adequate",
        Named => "named",
        Ambiguous => "ambiguous",
        Outside => "outside",
        Measurement => "measurement",
        Undecided => "undecided",
    }
}

/// Probabilities by name, and what follows from them.
#[derive(Debug, Clone)]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// Probability of each explanation as the first addition; they sum to 1. Best first.
    pub first: Vec<(Explanation, f64)>,
    /// Probability that an effect is present at all, alone or with others.
    pub present: BTreeMap<String, f64>,
    /// Smallest set of explanations that holds 95 % of the probability.
    pub credible: Vec<Explanation>,
    /// Effects sure enough to be named.
    pub sure: Vec<String>,
    /// Probability that something outside the catalogue is at work.
    pub outside: f64,
    /// True when the best explanation failed on held-out data.
    pub refuted: bool,
    /// True when something outside the catalogue is there, and too small to matter.
    pub outside_is_small: bool,
}

/// Judge the sets.
pub fn judge(sets: &Sets, candidates: &[Candidate]) -> Judgement {
    let terms = candidates.iter().filter_map(Candidate::id).map(|id| Explanation::Term(id.to_owned()));
    let mut first: BTreeMap<Explanation, f64> =
        terms.chain(Explanation::SPECIAL).map(|explanation| (explanation, 0.0)).collect();
    let mut present: BTreeMap<String, f64> = BTreeMap::new();
    let mut outside = 0.0;
    for set in &sets.sets {
        let (plain, discrepant) = (sets.probability(set), sets.discrepant_probability(set));
        let patterned = set.members.iter().any(|&m| matches!(candidates[m].kind, CandidateKind::Pattern(_)));
        outside += discrepant + if patterned { plain } else { 0.0 };
        *first.entry(Explanation::Outside).or_default() += discrepant;
        let leader = if patterned { Explanation::Outside } else { leader(set, sets, candidates) };
        *first.entry(leader).or_default() += plain;
        for id in set.members.iter().filter_map(|&m| candidates[m].id()) {
            *present.entry(id.to_owned()).or_default() += plain + discrepant;
        }
    }
    let none = first.get(&Explanation::Nothing).copied().unwrap_or(0.0);
    let mut first: Vec<(Explanation, f64)> = first.into_iter().collect();
    first.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let sure: Vec<String> = present.iter().filter(|(_, p)| **p >= NAMED).map(|(id, _)| id.clone()).collect();
    let doubtful = is_doubtful(&present, &sure);
    let verdict = if outside > DOUBT {
        Verdict::Outside
    } else if none >= DOUBT {
        Verdict::Adequate
    } else if sure.is_empty() || doubtful || outside > SUSPICION {
        Verdict::Ambiguous
    } else {
        Verdict::Named
    };
    Judgement {
        verdict,
        first,
        present,
        credible: credible(sets, candidates),
        sure,
        outside,
        refuted: false,
        outside_is_small: false,
    }
}

impl Judgement {
    /// What is wrong is in the data: no effect is weighed.
    pub(crate) fn of_the_data() -> Self {
        let rest = Explanation::SPECIAL.into_iter().filter(|e| *e != Explanation::Nothing).map(|e| (e, 0.0));
        Self {
            verdict: Verdict::Measurement,
            first: std::iter::once((Explanation::Nothing, 1.0)).chain(rest).collect(),
            present: BTreeMap::new(),
            credible: vec![Explanation::Nothing],
            sure: Vec::new(),
            outside: 0.0,
            refuted: false,
            outside_is_small: false,
        }
    }

    /// True when nothing but a suspicion of something outside the catalogue keeps sure effects from being named.
    pub(crate) fn is_only_suspicious(&self) -> bool {
        let doubtful = is_doubtful(&self.present, &self.sure);
        self.verdict == Verdict::Ambiguous && !self.sure.is_empty() && !doubtful && self.outside <= DOUBT
    }

    /// What is outside the catalogue is too small to matter: the answer is what it would be without.
    pub(crate) fn pass_over_outside(&mut self) {
        self.outside_is_small = true;
        let doubtful = is_doubtful(&self.present, &self.sure);
        self.verdict = match (doubtful, self.sure.is_empty()) {
            (true, _) => Verdict::Ambiguous,
            (false, true) => Verdict::Adequate,
            (false, false) => Verdict::Named,
        };
    }

    /// Held-out readings show nothing outside the catalogue. Effects that were found beside it may have taken its place: they are open; so
    /// is what the readings fitted are sure of.
    pub(crate) fn withdraw_outside(&mut self) {
        let something = self.present.values().any(|p| *p >= DOUBT) || self.outside >= NAMED;
        self.verdict = if something { Verdict::Ambiguous } else { Verdict::Adequate };
        if something && !self.credible.contains(&Explanation::Nothing) {
            self.credible.push(Explanation::Nothing);
        }
    }
}

/// True when an effect that is not sure is more probable than not.
fn is_doubtful(present: &BTreeMap<String, f64>, sure: &[String]) -> bool {
    present.iter().any(|(id, p)| *p >= DOUBT && !sure.contains(id))
}

/// The member of a set that explains most when it stands alone.
fn leader(set: &Set, sets: &Sets, candidates: &[Candidate]) -> Explanation {
    let alone = |m: usize| {
        let single = sets.sets.iter().find(|s| s.members == [m]);
        single.map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let best = set.members.iter().copied().max_by(|&a, &b| alone(a).total_cmp(&alone(b)));
    best.and_then(|m| candidates[m].id()).map_or(Explanation::Nothing, |id| Explanation::Term(id.to_owned()))
}

/// Members of the most probable explanations until they hold 95 %; a discrepancy counts as an explanation of its own.
fn credible(sets: &Sets, candidates: &[Candidate]) -> Vec<Explanation> {
    let mut weighed: Vec<(f64, bool, &Set)> = sets
        .sets
        .iter()
        .flat_map(|s| [(sets.probability(s), false, s), (sets.discrepant_probability(s), true, s)])
        .collect();
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.members.cmp(&b.2.members)));
    let mut all: Vec<Explanation> = Vec::new();
    let mut held = 0.0;
    for (p, discrepant, set) in weighed {
        if held >= CREDIBLE {
            break;
        }
        held += p;
        let nothing = set.members.is_empty().then_some(Explanation::Nothing);
        let rest = if discrepant { Some(Explanation::Outside) } else { nothing };
        for explanation in set.members.iter().map(|&m| explanation(&candidates[m])).chain(rest) {
            if !all.contains(&explanation) {
                all.push(explanation);
            }
        }
    }
    all
}

/// The term, or something outside for a pattern.
fn explanation(candidate: &Candidate) -> Explanation {
    candidate.id().map_or(Explanation::Outside, |id| Explanation::Term(id.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Adequate, Ambiguous, Named, Outside};
    use super::*;
    use crate::terms::catalogue;

    /// Members of a set, and its probability without and with something outside the catalogue.
    type Weighed = (&'static [usize], f64, f64);

    fn judged(sets: &[Weighed]) -> Judgement {
        let terms = catalogue();
        let candidates: Vec<Candidate> =
            terms.iter().take(2).enumerate().map(|(k, term)| Candidate::of_block(term, k)).collect();
        let sets = sets.iter().map(|(members, plain, more)| Set::of_weights(members, plain.ln(), more.ln()));
        judge(&Sets { sets: sets.collect(), log_total: 0.0 }, &candidates)
    }

    #[test]
    fn what_is_named_and_what_stays_open_follows_from_the_probabilities() {
        let table: [(&[Weighed], Verdict, usize, usize); 8] = [
            (&[(&[0], 0.96, 0.0), (&[], 0.04, 0.0)], Named, 1, 1),
            (&[(&[0], 0.94, 0.0), (&[], 0.06, 0.0)], Ambiguous, 0, 2),
            // A second effect.
            (&[(&[0, 1], 0.55, 0.0), (&[0], 0.44, 0.0), (&[], 0.01, 0.0)], Ambiguous, 1, 2),
            (&[(&[0], 0.55, 0.0), (&[0, 1], 0.44, 0.0), (&[], 0.01, 0.0)], Named, 1, 2),
            // Something outside the catalogue.
            (&[(&[0], 0.87, 0.12), (&[], 0.01, 0.0)], Ambiguous, 1, 2),
            (&[(&[0], 0.90, 0.09), (&[], 0.01, 0.0)], Named, 1, 2),
            (&[(&[], 0.55, 0.45)], Adequate, 0, 2),
            (&[(&[], 0.45, 0.55)], Outside, 0, 2),
        ];
        for (sets, verdict, sure, credible) in table {
            let found = judged(sets);
            assert_eq!(
                (found.verdict, found.sure.len(), found.credible.len()),
                (verdict, sure, credible),
                "{sets:?}"
            );
            let is_suspicious = verdict == Ambiguous && found.outside > 0.0;
            assert_eq!(found.is_only_suspicious(), is_suspicious, "{sets:?}");
        }
    }

    #[test]
    fn of_two_effects_the_one_that_explains_more_alone_is_first() {
        let found = judged(&[(&[0, 1], 0.7, 0.0), (&[1], 0.2, 0.0), (&[0], 0.1, 0.0)]);
        let second = Explanation::Term(catalogue()[1].info().id.to_owned());
        assert_eq!(found.first[0].0, second);
        assert!((found.first[0].1 - 0.9).abs() < 1e-12);
    }

    #[test]
    fn what_was_found_beside_something_that_held_out_readings_deny_is_open_and_so_is_none() {
        for (sets, verdict, may_be_none) in [
            (&[(&[0_usize][..], 0.08, 0.6), (&[], 0.0, 0.32)][..], Ambiguous, true),
            (&[(&[0], 0.08, 0.4), (&[], 0.0, 0.52)], Adequate, false),
        ] {
            let mut found = judged(sets);
            found.withdraw_outside();
            let none = found.credible.iter().filter(|e| **e == Explanation::Nothing).count();
            assert_eq!((found.verdict, none), (verdict, usize::from(may_be_none)));
        }
    }
}
