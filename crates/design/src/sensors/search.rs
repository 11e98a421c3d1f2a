//! The best set: among all, where they are few, else by exchange.

use hexbench_core::parallel;
use hexbench_core::streams::{Purpose, stream};
use nalgebra::DMatrix;

use super::exchange::Draft;
use super::goal::require_any;
use super::{Goal, Offer};
use crate::DesignError;
use crate::determined::undetermined;

/// Sets are compared one by one up to this number.
const MOST_SETS: f64 = 50_000.0;
/// Relative difference below which two values count as the same.
const SAME: f64 = 1e-4;
/// Share of the mean information that keeps a set invertible until it determines everything.
const RIDGE: f64 = 1e-9;
/// Share of a budget that rounding excuses.
const ROUNDING: f64 = 1e-9;

/// How many sensors, and what they may cost together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Number of sensors; at most, where they have a budget.
    pub number: usize,
    /// Largest sum of their costs.
    pub budget: Option<f64>,
}

/// A set of candidates.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorSelection {
    /// Indices, ascending.
    pub members: Vec<usize>,
    /// Value of the goal.
    pub value: f64,
}

/// How a set was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// It is the best of all sets, so many.
    OfAll(u64),
    /// By exchange: starts, and those that ended at its value to four digits.
    ByExchange {
        /// Starts.
        starts: usize,
        /// Starts that ended here.
        agreeing: usize,
    },
}

/// A search for sensors.
pub struct SensorSearch<'a> {
    pub(super) offer: &'a Offer,
    pub(super) goal: &'a Goal,
    ridge: DMatrix<f64>,
}

impl<'a> SensorSearch<'a> {
    /// Prepares a search.
    ///
    /// # Errors
    /// [`DesignError::SensorsNeverDetermine`] when not even all candidates together determine the parameters,
    /// [`DesignError::NoCandidateShows`] when they show nothing of the effect.
    pub fn new(offer: &'a Offer, goal: &'a Goal) -> Result<Self, DesignError> {
        let whole = offer.sum(&(0..offer.candidates()).collect::<Vec<_>>());
        require_any(goal, offer, &whole)?;
        let ridge = DMatrix::from_diagonal(&(whole.diagonal() * (RIDGE / offer.candidates() as f64)));
        Ok(Self { offer, goal, ridge })
    }

    /// The best set within limits: of all, where there are few, else by exchange. None when it determines nothing.
    pub fn best(&self, limits: Limits, starts: usize, seed: u64) -> Option<(SensorSelection, Found)> {
        if self.sets(limits) <= MOST_SETS {
            self.enumerate(limits)
        } else {
            self.exchange(limits, starts, seed)
        }
    }

    /// Sets of so many, or of at most so many where there is a budget.
    fn sets(&self, limits: Limits) -> f64 {
        let n = self.offer.candidates();
        let of = |size: usize| (0..size).map(|k| (n - k) as f64 / (k + 1) as f64).product::<f64>();
        let number = limits.number.min(n);
        if limits.budget.is_some() { (1..=number).map(of).sum() } else { of(number) }
    }

    /// The best of all sets within limits; the first of equals. None when it determines nothing.
    pub fn enumerate(&self, limits: Limits) -> Option<(SensorSelection, Found)> {
        let all = |first: usize| {
            let mut walk = Walk { search: self, limits, members: Vec::new(), best: None, sets: 0 };
            walk.with(first, &self.start(), 0.0);
            (walk.best, walk.sets)
        };
        let ends: Vec<(Option<SensorSelection>, u64)> = parallel::map_range(self.offer.candidates(), &all);
        let sets = ends.iter().map(|e| e.1).sum();
        let best = ends.into_iter().filter_map(|e| e.0).reduce(|a, b| if b.value > a.value { b } else { a });
        Some((self.determined(best?)?, Found::OfAll(sets)))
    }

    /// The best set within limits that exchange finds from random starts. None when it determines nothing.
    pub fn exchange(&self, limits: Limits, starts: usize, seed: u64) -> Option<(SensorSelection, Found)> {
        let end = |start: usize| {
            let mut rng = stream(seed, Purpose::SensorStart, [limits.number as u64, start as u64]);
            Draft::random(self, limits, &mut rng).climbed()
        };
        let ends: Vec<SensorSelection> = parallel::map_range(starts, &end);
        let best = ends.iter().cloned().reduce(|a, b| if b.value > a.value { b } else { a })?;
        let agreeing = ends.iter().filter(|e| e.value >= (1.0 - SAME) * best.value).count();
        Some((self.determined(best)?, Found::ByExchange { starts, agreeing }))
    }

    /// The same set with its value, none when it determines nothing.
    fn determined(&self, best: SensorSelection) -> Option<SensorSelection> {
        let value = self.value(&best.members)?;
        Some(SensorSelection { value, ..best })
    }

    /// Value of a set; none when it does not determine the parameters.
    pub fn value(&self, members: &[usize]) -> Option<f64> {
        let information = self.offer.sum(members);
        let known = self.goal.of_parameters(self.offer, &information);
        undetermined(&known).is_empty().then(|| self.goal.value(&information, self.offer.readings))
    }

    /// The smallest number of sensors that determines the parameters, `from` so many on.
    pub fn enough(&self, limits: Limits, from: usize, starts: usize, seed: u64) -> Option<usize> {
        (from..=self.offer.candidates())
            .find(|&number| self.best(Limits { number, ..limits }, starts, seed).is_some())
    }

    /// What is known before any is chosen, made invertible.
    pub(super) fn start(&self) -> DMatrix<f64> {
        &self.offer.known + &self.ridge
    }

    pub(super) fn value_of(&self, information: &DMatrix<f64>) -> f64 {
        self.goal.value(information, self.offer.readings)
    }
}

impl Limits {
    /// True when so much more can be paid.
    pub(super) fn affords(&self, cost: f64) -> bool {
        self.budget.is_none_or(|most| cost <= most * (1.0 + ROUNDING))
    }
}

/// All sets that begin with some members.
struct Walk<'a, 'b> {
    search: &'a SensorSearch<'b>,
    limits: Limits,
    members: Vec<usize>,
    best: Option<SensorSelection>,
    sets: u64,
}

impl Walk<'_, '_> {
    /// All sets that go on with a member.
    fn with(&mut self, next: usize, information: &DMatrix<f64>, cost: f64) {
        let offer = self.search.offer;
        let cost = cost + offer.costs[next];
        if !self.limits.affords(cost) {
            return;
        }
        let information = information + &offer.information[next];
        self.members.push(next);
        let full = self.members.len() == self.limits.number.min(offer.candidates());
        if full || self.limits.budget.is_some() {
            self.judge(&information);
        }
        if !full {
            (next + 1..offer.candidates()).for_each(|k| self.with(k, &information, cost));
        }
        self.members.pop();
    }

    fn judge(&mut self, information: &DMatrix<f64>) {
        self.sets += 1;
        let value = self.search.value_of(information);
        if self.best.as_ref().is_none_or(|best| value > best.value) {
            self.best = Some(SensorSelection { members: self.members.clone(), value });
        }
    }
}
