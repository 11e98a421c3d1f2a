//! Scans for laws beside several explanations, and the competition of what they find with the catalogue.

use std::sync::Arc;

use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::fit;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::inference::diagnosis::{RankedSets, explain_with_laws};
use crate::inference::discovery::{LawSearch, LawTerm};
use crate::inference::search::Set;

/// Laws taken from the scan beside the springs alone.
const BESIDE_SPRINGS: usize = 8;
/// Laws taken from each further scan.
const BESIDE_OTHERS: usize = 4;
/// Single effects of the catalogue beside which laws are scanned.
const SINGLE_EFFECTS: usize = 2;
/// Evidence that a single effect needs for that, nats.
const WORTH_A_SCAN: f64 = 10.0;
/// Rounds in which a further law is searched beside those found.
const ROUNDS: usize = 2;
/// Scans and weighings together, at most.
pub(super) const MOST_STEPS: u64 = (1 + 1 + SINGLE_EFFECTS + 2 * ROUNDS - 1) as u64;

/// What competes, and how it came out.
pub(super) struct Searched {
    pub(super) outcome: RankedSets,
    pub(super) laws: Vec<LawTerm>,
    pub(super) tried: usize,
}

/// Laws found so far.
struct Pool<'a> {
    campaign: &'a Campaign,
    grammar: LawSearch,
    laws: Vec<LawTerm>,
    tried: usize,
    watch: &'a dyn Fn(),
}

/// Searches laws beside springs and catalogue; `outcome`: how the catalogue explains the campaign.
pub(super) fn search(
    campaign: &Campaign,
    outcome: &RankedSets,
    terms: &[Arc<dyn Term>],
    watch: &dyn Fn(),
) -> Result<Searched, ModelError> {
    let lin = Linearization::at(campaign, &outcome.baseline.point)?;
    let grammar = LawSearch::new(campaign, &lin, outcome.natural)?;
    let mut pool = Pool { campaign, grammar, laws: Vec::new(), tried: 0, watch };
    pool.scan(&outcome.baseline.point, BESIDE_SPRINGS)?;
    for point in explanations(campaign, outcome) {
        pool.scan(&point, BESIDE_OTHERS)?;
    }
    let mut ranked = pool.weighed(terms)?;
    for _ in 1..ROUNDS {
        let before = pool.laws.len();
        pool.scan(&ranked.best.point, BESIDE_OTHERS)?;
        if pool.laws.len() == before {
            break;
        }
        ranked = pool.weighed(terms)?;
    }
    Ok(Searched { outcome: ranked, laws: pool.laws, tried: pool.tried })
}

impl Pool<'_> {
    fn weighed(&self, terms: &[Arc<dyn Term>]) -> Result<RankedSets, ModelError> {
        let ranked = explain_with_laws(self.campaign, terms, &self.laws)?;
        (self.watch)();
        Ok(ranked)
    }

    fn scan(&mut self, point: &ModelPoint, most: usize) -> Result<(), ModelError> {
        let lin = Linearization::at(self.campaign, point)?;
        // The same laws beside another model are not other laws.
        self.tried = self.tried.max(self.grammar.scan(self.campaign, &lin, point, most, &mut self.laws)?);
        (self.watch)();
        Ok(())
    }
}

/// Models of the catalogue beside which a law may stand: its best set, and its strongest single effects.
fn explanations(campaign: &Campaign, outcome: &RankedSets) -> Vec<ModelPoint> {
    let mut points = Vec::new();
    if !outcome.best.point.active.is_empty() {
        points.push(outcome.best.point.clone());
    }
    let nothing = outcome.sets.sets.iter().find(|s| s.members.is_empty()).map_or(0.0, |s| s.log_weight);
    let is_single = |s: &&Set| {
        s.members.len() == 1
            && s.log_weight > nothing + WORTH_A_SCAN
            && outcome.candidates[s.members[0]].id().is_some()
    };
    for set in outcome.sets.sets.iter().filter(is_single).take(SINGLE_EFFECTS) {
        let terms = outcome.wanted(set);
        if let Ok(fitted) = fit(campaign, &terms, Some(&outcome.baseline.point)) {
            points.push(fitted.point);
        }
    }
    points
}
