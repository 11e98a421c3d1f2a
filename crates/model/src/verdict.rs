//! From probabilities of sets to a verdict.

use std::collections::BTreeMap;

use crate::candidates::{Candidate, Kind};
use crate::search::{Set, Sets};

/// Probability an effect must have to be named.
pub const NAMED: f64 = 0.95;
/// Probability of any further effect above which a named set is not the whole answer.
const DOUBT: f64 = 0.5;
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
}

impl Verdict {
    /// One word, as in the files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Adequate => "adequate",
            Self::Named => "named",
            Self::Ambiguous => "ambiguous",
            Self::Outside => "outside",
        }
    }
}

/// Probabilities by name, and what follows from them.
#[derive(Debug, Clone)]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// Probability of each term, of "outside" and of "none", as the first addition; they sum to 1. Best first.
    pub first: Vec<(String, f64)>,
    /// Probability that an effect is present at all, alone or with others.
    pub present: BTreeMap<String, f64>,
    /// Smallest set of effects that holds 95 % of the probability.
    pub credible: Vec<String>,
    /// Effects sure enough to be named.
    pub sure: Vec<String>,
    /// Probability that something outside the catalogue is at work.
    pub outside: f64,
    /// True when the best explanation failed on held-out data.
    pub refuted: bool,
}

/// Name of what is not a term.
pub const OUTSIDE: &str = "outside";
/// Name of no effect at all.
pub const NONE: &str = "none";

/// Judge the sets.
pub fn judge(sets: &Sets, candidates: &[Candidate]) -> Judgement {
    let mut first: BTreeMap<String, f64> =
        candidates.iter().filter_map(|c| Some((c.id()?.to_owned(), 0.0))).collect();
    first.extend([(OUTSIDE.to_owned(), 0.0), (NONE.to_owned(), 0.0)]);
    let mut present: BTreeMap<String, f64> = BTreeMap::new();
    let mut outside = 0.0;
    for set in &sets.sets {
        let (plain, discrepant) = (sets.probability(set), sets.discrepant_probability(set));
        let patterned = set.members.iter().any(|&m| matches!(candidates[m].kind, Kind::Pattern(_)));
        outside += discrepant + if patterned { plain } else { 0.0 };
        *first.entry(OUTSIDE.to_owned()).or_default() += discrepant;
        *first
            .entry(if patterned { OUTSIDE.to_owned() } else { leader(set, sets, candidates) })
            .or_default() += plain;
        for id in set.members.iter().filter_map(|&m| candidates[m].id()) {
            *present.entry(id.to_owned()).or_default() += plain + discrepant;
        }
    }
    let mut first: Vec<(String, f64)> = first.into_iter().collect();
    first.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let sure: Vec<String> = present.iter().filter(|(_, p)| **p >= NAMED).map(|(id, _)| id.clone()).collect();
    let none = first.iter().find(|f| f.0 == NONE).map_or(0.0, |f| f.1);
    let doubtful = present.iter().any(|(id, p)| *p >= DOUBT && !sure.contains(id));
    let verdict = if outside > DOUBT {
        Verdict::Outside
    } else if none >= DOUBT {
        Verdict::Adequate
    } else if sure.is_empty() || doubtful || outside > 1.0 - NAMED {
        Verdict::Ambiguous
    } else {
        Verdict::Named
    };
    Judgement { verdict, first, present, credible: credible(sets, candidates), sure, outside, refuted: false }
}

/// The member of a set that explains most when it stands alone.
fn leader(set: &Set, sets: &Sets, candidates: &[Candidate]) -> String {
    let alone = |m: usize| {
        let single = sets.sets.iter().find(|s| s.members == [m]);
        single.map_or(f64::NEG_INFINITY, |s| s.log_weight)
    };
    let best = set.members.iter().copied().max_by(|&a, &b| alone(a).total_cmp(&alone(b)));
    best.and_then(|m| candidates[m].id()).unwrap_or(NONE).to_owned()
}

/// Members of the most probable explanations until they hold 95 %; a discrepancy counts as an explanation of its own.
fn credible(sets: &Sets, candidates: &[Candidate]) -> Vec<String> {
    let mut weighed: Vec<(f64, bool, &Set)> = sets
        .sets
        .iter()
        .flat_map(|s| [(sets.probability(s), false, s), (sets.discrepant_probability(s), true, s)])
        .collect();
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.members.cmp(&b.2.members)));
    let mut names: Vec<String> = Vec::new();
    let mut held = 0.0;
    for (p, discrepant, set) in weighed {
        if held >= CREDIBLE {
            break;
        }
        held += p;
        let mut labels: Vec<&str> =
            set.members.iter().map(|&m| candidates[m].id().unwrap_or(OUTSIDE)).collect();
        if discrepant {
            labels.push(OUTSIDE);
        } else if set.members.is_empty() {
            labels.push(NONE);
        }
        for label in labels {
            if !names.iter().any(|n| n == label) {
                names.push(label.to_owned());
            }
        }
    }
    names
}
