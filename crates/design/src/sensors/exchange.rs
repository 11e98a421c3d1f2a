//! Exchange of members for candidates, from a random set until nothing helps (Fedorov 1972).

use nalgebra::DMatrix;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::search::{Limits, SensorSearch, SensorSelection};

/// Relative gain below which a move is rounding.
const LEAST_GAIN: f64 = 1e-9;

/// A set under construction.
#[derive(Clone)]
pub(super) struct Draft<'a, 'b> {
    search: &'a SensorSearch<'b>,
    limits: Limits,
    members: Vec<usize>,
    information: DMatrix<f64>,
    cost: f64,
    value: f64,
}

impl<'a, 'b> Draft<'a, 'b> {
    fn of(search: &'a SensorSearch<'b>, limits: Limits, members: Vec<usize>) -> Self {
        let offer = search.offer;
        let information = members.iter().fold(search.start(), |sum, &k| sum + &offer.information[k]);
        let cost = members.iter().map(|&k| offer.costs[k]).sum();
        let value = search.value_of(&information);
        Self { search, limits, members, information, cost, value }
    }

    /// As many at random as the limits allow.
    pub(super) fn random(search: &'a SensorSearch<'b>, limits: Limits, rng: &mut Pcg64) -> Self {
        let mut left: Vec<usize> = (0..search.offer.candidates()).collect();
        let (mut members, mut cost) = (Vec::new(), 0.0);
        while members.len() < limits.number && !left.is_empty() {
            let k = left.swap_remove(rng.random_range(0..left.len()));
            if limits.affords(cost + search.offer.costs[k]) {
                cost += search.offer.costs[k];
                members.push(k);
            }
        }
        Self::of(search, limits, members)
    }

    /// Moved until no move helps.
    pub(super) fn climbed(mut self) -> SensorSelection {
        while let Some(better) =
            self.added().or_else(|| self.exchanged()).or_else(|| self.exchanged_for_several())
        {
            self = better;
        }
        self.members.sort_unstable();
        SensorSelection { members: self.members, value: self.value }
    }

    /// With the candidate that helps most for its cost.
    fn added(&self) -> Option<Self> {
        let per_cost = |k: usize, value: f64| {
            let cost = if self.limits.budget.is_some() { self.search.offer.costs[k] } else { 1.0 };
            (value - self.value) / cost
        };
        let k = self.best_of(&self.information, self.cost, self.members.len(), per_cost)?;
        self.better(self.members.iter().copied().chain([k]).collect())
    }

    /// With one member exchanged for the candidate that helps most: the best of all such exchanges.
    fn exchanged(&self) -> Option<Self> {
        let each = (0..self.members.len()).filter_map(|place| {
            let (rest, information, cost) = self.without(place);
            let k = self.best_of(&information, cost, rest.len(), |_, value| value)?;
            self.better(rest.into_iter().chain([k]).collect())
        });
        each.reduce(|a, b| if b.value > a.value { b } else { a })
    }

    /// With one member exchanged for several cheaper ones, or several given for one: only a budget asks for it.
    fn exchanged_for_several(&self) -> Option<Self> {
        self.limits.budget?;
        let fewer = (0..self.members.len()).filter_map(|place| {
            let (rest, ..) = self.without(place);
            let out = self.members[place];
            self.kept_better(Self::of(self.search, self.limits, rest).filled(Some(out)))
        });
        let outside = (0..self.search.offer.candidates()).filter(|k| !self.members.contains(k));
        let more = outside.filter_map(|k| {
            let mut trial = Self::of(self.search, self.limits, vec![k]);
            if !self.limits.affords(trial.cost) {
                return None;
            }
            let mut others = self.members.clone();
            while let Some(next) = trial.best_among(&others) {
                others.retain(|&other| other != next);
                trial =
                    Self::of(self.search, self.limits, trial.members.iter().copied().chain([next]).collect());
            }
            self.kept_better(trial.filled(None))
        });
        fewer.chain(more).reduce(|a, b| if b.value > a.value { b } else { a })
    }

    /// Filled by what helps most for its cost, but for one candidate.
    fn filled(mut self, without: Option<usize>) -> Self {
        let all: Vec<usize> = (0..self.search.offer.candidates()).filter(|k| Some(*k) != without).collect();
        while let Some(k) = self.best_among(&all) {
            self = Self::of(self.search, self.limits, self.members.iter().copied().chain([k]).collect());
        }
        self
    }

    /// The affordable one among some that helps most for its cost.
    fn best_among(&self, some: &[usize]) -> Option<usize> {
        let rate = |k: usize, value: f64| (value - self.value) / self.search.offer.costs[k];
        self.best_with(some.iter().copied(), &self.information, self.cost, self.members.len(), rate)
    }

    fn best_of(
        &self,
        information: &DMatrix<f64>,
        cost: f64,
        count: usize,
        worth: impl Fn(usize, f64) -> f64,
    ) -> Option<usize> {
        self.best_with(0..self.search.offer.candidates(), information, cost, count, worth)
    }

    /// The affordable candidate that is worth most beside some information.
    fn best_with(
        &self,
        some: impl Iterator<Item = usize>,
        information: &DMatrix<f64>,
        cost: f64,
        count: usize,
        worth: impl Fn(usize, f64) -> f64,
    ) -> Option<usize> {
        if count >= self.limits.number {
            return None;
        }
        let offer = self.search.offer;
        let free = some.filter(|k| !self.members.contains(k) && self.limits.affords(cost + offer.costs[*k]));
        let judged =
            free.map(|k| (k, worth(k, self.search.value_of(&(information + &offer.information[k])))));
        judged.reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(k, _)| k)
    }

    fn without(&self, place: usize) -> (Vec<usize>, DMatrix<f64>, f64) {
        let offer = self.search.offer;
        let out = self.members[place];
        let rest = self.members.iter().copied().filter(|&k| k != out).collect();
        (rest, &self.information - &offer.information[out], self.cost - offer.costs[out])
    }

    fn better(&self, members: Vec<usize>) -> Option<Self> {
        self.kept_better(Self::of(self.search, self.limits, members))
    }

    fn kept_better(&self, trial: Self) -> Option<Self> {
        (trial.value > self.value * (1.0 + LEAST_GAIN)).then_some(trial)
    }
}
