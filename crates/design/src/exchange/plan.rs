//! A plan under construction: members, what they cost and what they tell.

use nalgebra::DMatrix;

use super::Exchange;

/// Candidates whose first-order gain is among this many largest are evaluated exactly.
const SHORT_LIST: usize = 12;
/// Share of the budget that rounding excuses.
const ROUNDING: f64 = 1e-9;

/// Members with the sum of their information, and how often each pose is read.
#[derive(Clone)]
pub(super) struct Draft<'a, 'c> {
    exchange: &'a Exchange<'c>,
    pub(super) members: Vec<usize>,
    visits: Vec<usize>,
    information: DMatrix<f64>,
    spent: f64,
}

/// What a move is judged by.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum By {
    /// The value after it.
    Value,
    /// The gain per cost.
    Rate,
}

impl<'a, 'c> Draft<'a, 'c> {
    pub(super) fn new(exchange: &'a Exchange<'c>, members: Vec<usize>) -> Self {
        let c = exchange.candidates;
        let mut visits = vec![0; c.poses()];
        for &k in &members {
            visits[c.pose(k)] += 1;
        }
        let information = &exchange.ridge + c.sum(&members);
        Self { spent: c.cost_of(&members), exchange, members, visits, information }
    }

    pub(super) fn candidate_count(&self) -> usize {
        self.exchange.candidates.information.len()
    }

    pub(super) fn value(&self) -> f64 {
        self.exchange.value(&self.information)
    }

    /// Whether it costs no more than the budget.
    pub(super) fn fits(&self) -> bool {
        self.spent <= self.exchange.candidates.budget * (1.0 + ROUNDING)
    }

    /// What a candidate adds to the cost.
    pub(super) fn added_cost(&self, candidate: usize) -> f64 {
        let c = self.exchange.candidates;
        let way = if self.visits[c.pose(candidate)] == 0 { c.pose_cost } else { 0.0 };
        c.cost(candidate) + way
    }

    pub(super) fn affords(&self, candidate: usize) -> bool {
        let most = self.exchange.candidates.budget * (1.0 + ROUNDING);
        self.spent + self.added_cost(candidate) <= most
    }

    pub(super) fn add(&mut self, candidate: usize) {
        let c = self.exchange.candidates;
        self.spent += self.added_cost(candidate);
        self.visits[c.pose(candidate)] += 1;
        self.information += &c.information[candidate];
        self.members.push(candidate);
    }

    pub(super) fn remove(&mut self, position: usize) -> usize {
        let c = self.exchange.candidates;
        let candidate = self.members.swap_remove(position);
        self.visits[c.pose(candidate)] -= 1;
        self.information -= &c.information[candidate];
        self.spent -= self.added_cost(candidate);
        candidate
    }

    /// Takes all readings of a pose away; gives their settings.
    pub(super) fn leave(&mut self, pose: usize) -> Vec<usize> {
        let c = self.exchange.candidates;
        let (gone, kept): (Vec<usize>, _) = self.members.iter().partition(|&&k| c.pose(k) == pose);
        *self = Self::new(self.exchange, kept);
        gone.iter().map(|k| k % c.costs.len()).collect()
    }

    /// Reads a pose under settings.
    pub(super) fn visit(&mut self, pose: usize, settings: &[usize]) {
        let first = pose * self.exchange.candidates.costs.len();
        for setting in settings {
            self.add(first + setting);
        }
    }

    /// Poses that are read, ascending.
    pub(super) fn visited(&self) -> Vec<usize> {
        (0..self.visits.len()).filter(|&pose| self.visits[pose] > 0).collect()
    }

    /// The affordable candidate that helps most.
    pub(super) fn best_addition(&self, by: By) -> Option<usize> {
        let affordable: Vec<usize> = (0..self.candidate_count()).filter(|&k| self.affords(k)).collect();
        self.best_of(affordable, by)
    }

    /// The candidate that helps most, affordable or not.
    pub(super) fn best_of(&self, candidates: Vec<usize>, by: By) -> Option<usize> {
        let information = &self.exchange.candidates.information;
        let (now, slope) = self.exchange.criterion.gradient(&self.information, 1);
        let per = |k: usize| if by == By::Rate { self.added_cost(k) } else { 1.0 };
        let promise = |k: usize| slope.dot(&information[k]) / per(k);
        let gain = |k: usize| (self.exchange.value(&(&self.information + &information[k])) - now) / per(k);
        largest(short_list(candidates, promise), gain)
    }

    /// The pose that does best under settings.
    pub(super) fn best_pose(&self, settings: &[usize]) -> Option<usize> {
        let c = self.exchange.candidates;
        let (_, slope) = self.exchange.criterion.gradient(&self.information, 1);
        let of = |pose: usize| settings.iter().map(move |s| &c.information[pose * c.costs.len() + s]);
        let promise = |pose: usize| of(pose).map(|m| slope.dot(m)).sum();
        let value =
            |pose: usize| self.exchange.value(&of(pose).fold(self.information.clone(), |sum, m| sum + m));
        largest(short_list((0..c.poses()).collect(), promise), value)
    }

    /// Position of the member that is missed least for what it costs.
    pub(super) fn least_useful(&self) -> Option<usize> {
        let c = self.exchange.candidates;
        let (now, slope) = self.exchange.criterion.gradient(&self.information, 1);
        let freed = |k: usize| c.cost(k) + if self.visits[c.pose(k)] == 1 { c.pose_cost } else { 0.0 };
        let promise = |i: usize| -slope.dot(&c.information[self.members[i]]) / freed(self.members[i]);
        let loss = |i: usize| {
            let k = self.members[i];
            (self.exchange.value(&(&self.information - &c.information[k])) - now) / freed(k)
        };
        largest(short_list((0..self.members.len()).collect(), promise), loss)
    }
}

/// The few with the largest promise.
fn short_list(mut items: Vec<usize>, promise: impl Fn(usize) -> f64) -> Vec<usize> {
    if items.len() > SHORT_LIST {
        let mut ranked: Vec<(f64, usize)> = items.into_iter().map(|k| (promise(k), k)).collect();
        let down = |a: &(f64, usize), b: &(f64, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        ranked.select_nth_unstable_by(SHORT_LIST - 1, down);
        ranked.truncate(SHORT_LIST);
        ranked.sort_by(down);
        items = ranked.into_iter().map(|(_, k)| k).collect();
    }
    items
}

/// The first of those with the largest worth.
fn largest(items: Vec<usize>, worth: impl Fn(usize) -> f64) -> Option<usize> {
    let judged = items.into_iter().map(|k| (k, worth(k))).filter(|(_, w)| !w.is_nan());
    judged.reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(k, _)| k)
}
