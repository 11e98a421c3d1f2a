//! Rival sets at their own optimum.
//!
//! The search weighs all sets where the incumbent's fit ends. A rival whose effects are far from linear there, or that the springs of the
//! incumbent do not suit, looks worse than it is. So the leading sets are fitted, linearized where their own fit ends, and weighed there
//! by the same average over forms, shapes and widths; the likelihoods of two points of linearization differ by what the springs alone
//! would leave at either:
//!
//! ```text
//! ln Z(set) = ln Z(set | own point) + ln L0(own point) - ln L0(point of the search)
//! ```

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;

use crate::effects::term::Natural;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, fit};
use crate::estimation::linearization::Linearization;
use crate::inference::candidates::{Candidate, CandidateKind, Collector, with_fitted_shapes};
use crate::inference::diagnosis::wanted;
use crate::inference::evidence::Gram;
use crate::inference::search::{Set, Sets, TermSearch};

/// Sets looked at.
const MOST_RIVALS: usize = 20;
/// Sets this many nats below the best are left where they are, unless the best one does not fit.
const HOPELESS: f64 = 7.0;
/// Share of its drop of chi-square that a set may gain when the logarithm of a shape changes by one, and as its square: what lies
/// between the values of a grid.
const OF_A_SHAPE: f64 = 0.05;

/// A search whose leading sets are weighed anew.
pub(crate) struct Rivals<'a> {
    pub(crate) campaign: &'a Campaign,
    pub(crate) gram: &'a Gram,
    pub(crate) candidates: &'a [Candidate],
    pub(crate) natural: &'a Natural,
    /// Fit of the first set, which the search was linearized at.
    pub(crate) best: &'a Fit,
    /// True when that fit leaves more than the noise: then any set may be the better one.
    pub(crate) all: bool,
}

impl Rivals<'_> {
    /// The sets in the order of their weights at their own optimum, and the fit of the first one when it was not first before.
    pub(crate) fn weighed(&self, sets: Sets) -> (Sets, Option<Fit>) {
        let Some(first) = sets.sets.first().cloned() else { return (sets, None) };
        // The best set and something more is judged well where the best set is.
        let differs = |s: &Set| !first.members.iter().all(|m| s.members.contains(m));
        let hopeless = |s: &Set| s.log_weight < first.log_weight - HOPELESS - self.gain_of_shapes(s);
        let close = |s: &&Set| self.all || (!hopeless(s) && differs(s));
        let rivals = sets.sets.iter().skip(1).filter(close).take(MOST_RIVALS);
        let own = parallel::filter_map(&self.by_terms(rivals), |(terms, alike)| {
            go_on();
            self.at_own_optimum(terms, alike).ok()
        });
        let own: Vec<(Set, Fit)> = own.into_iter().flatten().collect();
        let better = own.iter().max_by(|a, b| a.0.log_weight.total_cmp(&b.0.log_weight));
        let better = better.filter(|(set, _)| set.log_weight > first.log_weight).map(|(_, fit)| fit.clone());
        (sets.with(own.into_iter().map(|(set, _)| set)), better)
    }

    /// Log-evidence that a set may gain when its shapes are fitted.
    fn gain_of_shapes(&self, set: &Set) -> f64 {
        let members = set.members.iter().zip(&set.variants);
        let widest = members.map(|(&m, v)| self.candidates[m].step_of_shape(v.block, &self.gram.blocks));
        0.5 * OF_A_SHAPE * (0.5 * widest.fold(0.0, f64::max)).powi(2) * set.drop
    }

    /// Sets of the same terms have one optimum: patterns take no part in a fit.
    fn by_terms<'a>(&self, sets: impl Iterator<Item = &'a Set>) -> Vec<(Vec<TermSpec>, Vec<&'a Set>)> {
        let mut all: Vec<(Vec<TermSpec>, Vec<&Set>)> = Vec::new();
        for set in sets {
            let terms = wanted(set, self.gram, self.candidates, self.natural);
            match all.iter_mut().find(|(known, _)| *known == terms) {
                Some((_, alike)) => alike.push(set),
                None => all.push((terms, vec![set])),
            }
        }
        all
    }

    /// Sets of these terms, and the fit of them.
    fn at_own_optimum(&self, terms: &[TermSpec], sets: &[&Set]) -> Result<Vec<(Set, Fit)>, ModelError> {
        let own = fit(self.campaign, terms, Some(&self.best.point))?;
        let lin = Linearization::at(self.campaign, &own.point)?;
        let weighed = sets.iter().filter_map(|set| Some((self.weighed_at(set, &own, &lin)?, own.clone())));
        Ok(weighed.collect())
    }

    /// One set where a fit of its terms ended; none where nothing as large was found there.
    fn weighed_at(&self, set: &Set, own: &Fit, lin: &Linearization) -> Option<Set> {
        let mut collector = Collector::new(lin, *self.natural);
        for &m in &set.members {
            self.add(&mut collector, &self.candidates[m], own);
        }
        let (gram, candidates) = collector.finish(self.campaign, &own.point);
        let search = TermSearch::new(&gram, &candidates, self.campaign.noise.allows_verdict());
        let found = search.among(self.candidates).run(set.members.len());
        let moved = gram.log_likelihood_without() - self.gram.log_likelihood_without();
        let whole = found.sets.into_iter().find(|s| s.members.len() == set.members.len());
        whole.map(|s| set.weighing(s.log_weight + moved, s.log_weight_discrepant + moved))
    }

    /// A candidate in the forms and shapes in which it competed, and in the shape that a fit gave it.
    fn add(&self, collector: &mut Collector<'_>, candidate: &Candidate, own: &Fit) {
        match &candidate.kind {
            CandidateKind::Term(term) => {
                let forms = candidate.forms(&self.gram.blocks).collect();
                collector.add_forms(term, with_fitted_shapes(forms, own));
            }
            CandidateKind::Pattern(pattern) => collector.add_pattern(*pattern, candidate.log_weight),
        }
    }
}
