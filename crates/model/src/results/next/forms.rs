//! What the rivals expect in each of their forms: readings that separate two effects separate every form of one from every form of the
//! other, because the truth may have any, and a rival takes the form that suits it best.

use hexbench_core::parallel;

use super::belief::Belief;
use super::choice::Between;
use super::separation::{Pair, Separation};
use super::{RivalExplanation, RivalForm, least};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, fit};
use crate::inference::diagnosis::RankedSets;
use crate::inference::forms::other_forms;
use crate::inference::search::Set;

impl RivalForm {
    /// Forms of a set that the readings leave open, fitted; none of one to which nothing can be fitted.
    pub(crate) fn left_open(campaign: &Campaign, set: &Set, outcome: &RankedSets) -> Vec<Self> {
        parallel::filter_map(&other_forms(set, outcome), |form| {
            let fit = fit(campaign, &form.terms, Some(&outcome.best.point)).ok()?;
            Some(Self { fit, odds: form.odds })
        })
    }
}

/// Expectations of readings by all forms of some rivals.
pub(super) struct Expectations {
    /// One of every form.
    pub(super) beliefs: Vec<Belief>,
    /// Probability of every form, up to a common factor.
    pub(super) weights: Vec<f64>,
    /// The rival that has each of these forms.
    rival: Vec<usize>,
}

impl Expectations {
    /// Expectations of the readings of a plan.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub(super) fn of(
        plan: &Campaign,
        campaign: &Campaign,
        rivals: &[RivalExplanation],
    ) -> Result<Self, ModelError> {
        let forms: Vec<(usize, &Fit, f64)> = rivals
            .iter()
            .enumerate()
            .flat_map(|(k, rival)| {
                let first = rival.weight / (1.0 + rival.forms.iter().map(|form| form.odds).sum::<f64>());
                let others = rival.forms.iter().map(move |form| (k, &form.fit, first * form.odds));
                std::iter::once((k, &rival.fit, first)).chain(others)
            })
            .collect();
        Ok(Self {
            beliefs: parallel::try_map(&forms, |(_, fit, _)| Belief::of(plan, campaign, fit))?,
            weights: forms.iter().map(|(.., weight)| weight.max(f64::MIN_POSITIVE)).collect(),
            rival: forms.iter().map(|(rival, ..)| *rival).collect(),
        })
    }

    /// The rivals that have two forms.
    pub(super) fn rivals(&self, forms: Between) -> Between {
        forms.map(|form| self.rival[form])
    }

    /// Pairs of forms of different rivals.
    pub(super) fn pairs(&self) -> Vec<Between> {
        let n = self.beliefs.len();
        let all = (0..n).flat_map(|b| (0..b).map(move |a| [a, b]));
        all.filter(|&[a, b]| self.rival[a] != self.rival[b]).collect()
    }

    /// Pairs of forms of two rivals.
    fn pairs_of(&self, between: Between) -> impl Iterator<Item = Between> + '_ {
        self.pairs().into_iter().filter(move |&forms| self.rivals(forms) == between)
    }

    /// Mean logarithms of the Bayes factor between two forms by some readings.
    pub(super) fn log_bayes_factor(&self, forms: Between, readings: &[usize]) -> Option<[f64; 2]> {
        Some(self.pair(forms, readings)?.log_bayes_factor())
    }

    /// Separation of the two forms of two rivals that some readings separate least, and after which of the readings they differ how much.
    pub(super) fn hardest(&self, between: Between, readings: &[usize]) -> Option<Hardest> {
        let ratio = |forms: Between| Some((forms, least(self.log_bayes_factor(forms, readings)?)));
        let (forms, _) = self.pairs_of(between).filter_map(ratio).min_by(|a, b| a.1.total_cmp(&b.1))?;
        let after = |n: usize| self.log_bayes_factor(forms, &readings[..n]).unwrap_or([0.0; 2]);
        let separation = self.pair(forms, readings)?.separation();
        Some(Hardest { separation, course: (1..=readings.len()).map(after).collect() })
    }

    fn pair(&self, [a, b]: Between, readings: &[usize]) -> Option<Pair> {
        Pair::new(self.beliefs[a].moments(readings), self.beliefs[b].moments(readings))
    }
}

/// What readings promise about two rivals in the forms that are hardest to separate.
pub(super) struct Hardest {
    /// By all readings together.
    pub(super) separation: Separation,
    /// Mean logarithms of the Bayes factor after the first reading, the second, and so on.
    pub(super) course: Vec<[f64; 2]>,
}
