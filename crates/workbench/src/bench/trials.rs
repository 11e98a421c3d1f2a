//! Terms added to a model one at a time: the gain of each on fitted and on held-out readings.

use hexbench_core::interrupt::go_on;
use std::time::Instant;

use hexbench_model::estimation::fit_named::Added;
use hexbench_model::inference::gain::{HeldOutGain, UNLIKELY};
use hexbench_model::inference::selection::{FitInDetail, chance_of_gain};
use rayon::prelude::*;

use super::counted::Counted;
use super::refusal::Refusal;
use super::{LoadedCampaign, files, view};
use crate::wire::{TermTrial, Tried, Try};

impl LoadedCampaign {
    /// Each of these terms beside the selected ones, tested against the selected ones alone. One that cannot be fitted is left out.
    ///
    /// # Errors
    /// [`Refusal`] for a term that is unknown, and for a model that cannot be fitted.
    pub fn try_each(&self, asked: &Try) -> Result<Tried, Refusal> {
        let since = Instant::now();
        let terms = files::terms_with(&asked.selection.own, &self.limits)?;
        let source = &self.contents.data.source;
        let chosen = view::selected(&asked.selection.terms, &terms, source)?;
        let each = view::selected(&asked.each, &terms, source)?;
        let counted = Counted::of(self, &asked.selection.exclude)?;
        let present = self.in_detail(&counted, &asked.selection)?;
        let with = |added: &Added| {
            go_on();
            let all: Vec<Added> = chosen.iter().chain([added]).cloned().collect();
            self.in_detail_of(&counted, &asked.selection, &all).ok()
        };
        let tried: Vec<_> = each.par_iter().map(with).collect();
        let mut found: Vec<(f64, TermTrial)> = asked
            .each
            .iter()
            .zip(&tried)
            .filter_map(|(id, fitted)| Some(judged(id, asked.each.len(), &present, fitted.as_ref()?)))
            .collect();
        found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let trials = found.into_iter().map(|(_, trial)| trial).collect();
        Ok(Tried { trials, milliseconds: since.elapsed().as_secs_f64() * 1e3 })
    }
}

/// A term that is one of several tried, with what it gains in nats.
fn judged(id: &str, tried: usize, present: &FitInDetail, with: &FitInDetail) -> (f64, TermTrial) {
    let both = present.judged.held_out.and(with.judged.held_out);
    let gain = both.map(|_| HeldOutGain::of(&present.foreseen, &with.foreseen).nats);
    let with = &with.judged;
    let chance = chance_of_gain(&present.judged.fit, &with.fit).map(|one| of_the_best(one, tried));
    let trial = TermTrial {
        term: id.to_owned(),
        times_noise: with.error().times_noise(),
        gain,
        chance,
        better: chance.is_some_and(|chance| chance <= UNLIKELY) && gain.is_none_or(|nats| nats > 0.0),
    };
    (gain.unwrap_or(f64::NEG_INFINITY), trial)
}

/// Chance of the best of several, from that of one: at most their sum, however they depend on each other (Bonferroni).
fn of_the_best(one: f64, tried: usize) -> f64 {
    (one * tried as f64).min(1.0)
}
