//! Forms of an effect that the readings leave open: another version, the richer form, a shape on the other side of what it may be.

use crate::effects::term::Term;
use crate::estimation::fit::TermSpec;
use crate::inference::candidates::Candidate;
use crate::inference::diagnosis::RankedSets;
use crate::inference::evidence::{Gram, Variant, log_sum};
use crate::inference::search::Set;

/// Share of the probability of an effect below which a form of it is not looked at.
const LEAST_SHARE: f64 = 0.05;

/// Terms of a set in another form of one of its effects.
pub(crate) struct OtherForm {
    /// What is asked of a fit.
    pub(crate) terms: Vec<TermSpec>,
    /// How many times as probable it is as the form of the set itself.
    pub(crate) odds: f64,
}

/// Every form of one effect of a set that the readings leave open, beside the form of the set itself.
pub(crate) fn other_forms(set: &Set, outcome: &RankedSets) -> Vec<OtherForm> {
    let gram = &outcome.gram;
    let of_member = |k: usize| {
        let mut others = set.variants.clone();
        let own = others.remove(k);
        let candidate = &outcome.candidates[set.members[k]];
        let profile = gram.profile(&others, &candidate.blocks);
        let (same, others): (Vec<_>, Vec<_>) = shares(&profile, |a, b| is_within(candidate, gram, a, b))
            .into_iter()
            .partition(|(variant, _)| is_within(candidate, gram, own, *variant));
        let own_share = same.first().map_or(1.0, |(_, share)| *share);
        let asked = |(variant, share): (Variant, f64)| OtherForm {
            terms: outcome.wanted(&set.in_form(k, variant)),
            odds: share / own_share,
        };
        others.into_iter().filter(|(_, share)| *share >= LEAST_SHARE).map(asked).collect::<Vec<_>>()
    };
    (0..set.variants.len()).flat_map(of_member).collect()
}

/// The best variant of every form, and the share of its form in all; `profile`: the best first.
fn shares(profile: &[(Variant, f64)], is_within: impl Fn(Variant, Variant) -> bool) -> Vec<(Variant, f64)> {
    let total = log_sum(profile.iter().map(|p| p.1));
    let mut forms: Vec<(Variant, f64)> = Vec::new();
    for &(variant, log_evidence) in profile {
        let share = (log_evidence - total).exp();
        match forms.iter_mut().find(|(known, _)| is_within(*known, variant)) {
            Some((_, known)) => *known += share,
            None => forms.push((variant, share)),
        }
    }
    forms
}

/// True where a fit can lead from one variant of an effect to the other: one of the same version, or a special case of the usual one.
fn is_within(candidate: &Candidate, gram: &Gram, from: Variant, to: Variant) -> bool {
    let [(one, x), (other, y)] = [from, to].map(|v| (candidate.version(v.block), &gram.blocks[v.block]));
    let (Some(one), Some(other)) = (one, other) else { return one.is_none() && other.is_none() };
    let reach = |term: &dyn Term, shape: f64| term.shape_bounds(shape).map(f64::to_bits);
    let is_special = candidate.is_special(other.as_ref()) && !candidate.is_special(one.as_ref());
    (std::ptr::eq(one.info(), other.info()) || is_special)
        && x.rich == y.rich
        && reach(one.as_ref(), x.shape) == reach(other.as_ref(), y.shape)
}
