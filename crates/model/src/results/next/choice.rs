//! Choosing readings one after the other, each beside all those chosen before.
//!
//! For explanations with weights `w` the chance of deciding wrongly after the readings is at most
//! `sum_{a<b} sqrt(w_a w_b) exp(-D_ab)` with the Bhattacharyya distance
//! `D_ab = d' V^-1 d / 8 + ln(|V| / sqrt(|V_a| |V_b|)) / 2`, `V = (V_a + V_b) / 2`, of their expectations; the next reading is the
//! one that lowers this bound most. Pairs that are separated already no longer count, and what one explanation can still refit
//! does not separate. Sources: Kailath 1967, IEEE Transactions on Communication Technology 15 (the bound); Box and Hill 1967,
//! Technometrics 9 (weighing pairs by probability, uncertain parameters included).

use hexbench_core::parallel;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::belief::Belief;
use super::filter::{Addition, Filter};
use super::forms::Expectations;
use crate::inference::evidence::log_sum;

/// A reading that lowers the logarithm of the bound by this share of the most is as good when it is simpler.
const NEARLY: f64 = 0.93;

/// Two explanations by their places in the list.
pub type Between = [usize; 2];

/// Expectations of the candidate readings by several explanations, and what has been chosen of it so far.
pub(super) struct Choice {
    alone: Vec<Filter>,
    pairs: Vec<PairState>,
    readings: usize,
}

struct PairState {
    between: Between,
    log_weight: f64,
    filter: Filter,
    /// Bhattacharyya distance by the readings chosen.
    distance: f64,
}

impl Choice {
    /// Nothing chosen yet.
    pub(super) fn new(expected: &Expectations) -> Self {
        let Expectations { beliefs, weights, .. } = expected;
        let none = |b: &Belief| DVector::zeros(b.mean.len());
        let alone: Vec<Filter> =
            parallel::map(beliefs, |b| Filter::new(b.rows.clone(), b.covariance.clone(), &none(b)));
        let state = |&[a, b]: &Between| PairState {
            between: [a, b],
            log_weight: 0.5 * (weights[a] * weights[b]).ln(),
            filter: between(&beliefs[a], &beliefs[b]),
            distance: 0.0,
        };
        let readings = beliefs.first().map_or(0, |b| b.mean.len() / 6);
        Self { alone, pairs: parallel::map(&expected.pairs(), state), readings }
    }

    /// The reading that lowers the bound most, or a simpler one that lowers it nearly as much, and by what factor (logarithm).
    pub(super) fn best(&self, effort: &[usize]) -> Option<(usize, f64)> {
        let drops: Vec<f64> = parallel::map_range(self.readings, &|i| self.drop(i));
        let most = drops.iter().copied().fold(0.0, f64::max);
        let nearly = (0..self.readings).filter(|&i| drops[i] > 0.0 && drops[i] >= NEARLY * most);
        let best = nearly.min_by(|&a, &b| effort[a].cmp(&effort[b]).then(drops[b].total_cmp(&drops[a])))?;
        Some((best, drops[best]))
    }

    /// By what factor (logarithm) a reading lowers the bound.
    pub(super) fn drop(&self, reading: usize) -> f64 {
        self.log_bound() - self.log_bound_with(reading)
    }

    /// The pair whose part of the bound a reading lowers most.
    pub(super) fn separated_most(&self, reading: usize) -> Option<Between> {
        let alone = self.alone_additions(reading);
        let lowered = |p: &PairState| {
            let before = p.log_weight - p.distance;
            before.exp() * -(-p.gain(reading, &alone)).exp_m1()
        };
        let best = self.pairs.iter().max_by(|a, b| lowered(a).total_cmp(&lowered(b)));
        best.map(|p| p.between)
    }

    /// Choose a reading.
    pub(super) fn choose(&mut self, reading: usize) {
        let alone = self.alone_additions(reading);
        for p in &mut self.pairs {
            p.distance += p.gain(reading, &alone);
        }
        let filters = self.alone.iter_mut().chain(self.pairs.iter_mut().map(|p| &mut p.filter));
        filters.collect::<Vec<_>>().into_par_iter().for_each(|f| f.choose(reading));
    }

    fn alone_additions(&self, reading: usize) -> Vec<Addition> {
        self.alone.iter().map(|f| f.addition(reading)).collect()
    }

    fn log_bound(&self) -> f64 {
        log_sum(self.pairs.iter().map(|p| p.log_weight - p.distance))
    }

    fn log_bound_with(&self, reading: usize) -> f64 {
        let alone = self.alone_additions(reading);
        let terms: Vec<f64> =
            self.pairs.iter().map(|p| p.log_weight - p.distance - p.gain(reading, &alone)).collect();
        log_sum(terms.iter().copied())
    }
}

impl PairState {
    /// What a reading adds to the distance.
    fn gain(&self, reading: usize, alone: &[Addition]) -> f64 {
        let both = self.filter.addition(reading);
        let [a, b] = self.between.map(|k| alone[k].log_det);
        0.125 * both.square + 0.5 * both.log_det - 0.25 * (a + b)
    }
}

/// The mean of two expectations' covariances is that of a model with the parameters of both, each with half its covariance.
fn between(a: &Belief, b: &Belief) -> Filter {
    let (p, q) = (a.rows.ncols(), b.rows.ncols());
    let mut rows = DMatrix::zeros(a.rows.nrows(), p + q);
    rows.columns_mut(0, p).copy_from(&a.rows);
    rows.columns_mut(p, q).copy_from(&b.rows);
    let mut covariance = DMatrix::zeros(p + q, p + q);
    covariance.view_mut((0, 0), (p, p)).copy_from(&(&a.covariance * 0.5));
    covariance.view_mut((p, p), (q, q)).copy_from(&(&b.covariance * 0.5));
    Filter::new(rows, covariance, &(&a.mean - &b.mean))
}
