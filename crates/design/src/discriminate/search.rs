//! The search: reading by reading, then exchange of each for a better one until nothing helps (Fedorov 1972).

use hexbench_core::parallel;
use hexbench_core::{Hexapod, Observation, Pose};
use hexbench_model::results::next::{ASPECTS, Aspect, MATTERS, Ordinary, effort};
use nalgebra::DMatrix;

use super::{Contest, Distance};
use crate::{DesignError, Space};

/// Rounds of exchange.
const ROUNDS: usize = 6;
/// Share of the smallest distance that simple poses may cost.
const GIVEN_FOR_SIMPLICITY: f64 = 0.03;
/// An exchange must enlarge the smallest distance by this share.
const LEAST_GAIN: f64 = 1e-6;

/// A reading of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedReading {
    /// What to set.
    pub observation: Observation,
    /// How often to read it.
    pub repeats: usize,
    /// What sort of reading it is.
    pub words: String,
}

/// A plan that separates rivals.
#[derive(Debug, Clone, PartialEq)]
pub struct SeparatingPlan {
    /// Its readings.
    pub readings: Vec<PlannedReading>,
    /// Distances of every effect from every other.
    pub distances: Vec<Distance>,
}

impl SeparatingPlan {
    /// The plan of `count` readings out of `candidate_readings`; `done` is called after each choice.
    ///
    /// # Errors
    /// A singular pose.
    pub fn search(
        contest: &Contest<'_>,
        space: &Space,
        hexapod: &Hexapod,
        candidate_readings: &[Observation],
        count: usize,
        done: &dyn Fn(),
    ) -> Result<Self, DesignError> {
        let informations = contest.informations(candidate_readings)?;
        let mut chosen = choose(contest, &informations, count, done);
        simplify(contest, &informations, candidate_readings, &mut chosen);
        let total = sum(&informations, &chosen);
        let mut distinct = chosen.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let repeats = |i: usize| chosen.iter().filter(|c| **c == i).count();
        let mut readings: Vec<PlannedReading> = distinct
            .iter()
            .map(|&i| PlannedReading {
                observation: candidate_readings[i],
                repeats: repeats(i),
                words: String::new(),
            })
            .collect();
        let own: Vec<&DMatrix<f64>> = distinct.iter().map(|&i| &informations[i]).collect();
        say(contest, space, hexapod, &total, &own, &mut readings)?;
        Ok(Self { readings, distances: contest.distances(&total) })
    }
}

fn choose(contest: &Contest<'_>, informations: &[DMatrix<f64>], count: usize, done: &dyn Fn()) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count && !informations.is_empty() {
        chosen.push(best(contest, informations, &sum(informations, &chosen)).0);
        done();
    }
    for _ in 0..ROUNDS {
        let mut helped = false;
        for k in 0..chosen.len() {
            let whole = sum(informations, &chosen);
            let rest = &whole - &informations[chosen[k]];
            let (other, bound) = best(contest, informations, &rest);
            if bound < contest.closeness(&whole) - LEAST_GAIN {
                chosen[k] = other;
                helped = true;
            }
        }
        if !helped {
            break;
        }
    }
    chosen
}

/// Exchanges readings for simpler ones that are nearly as good.
fn simplify(
    contest: &Contest<'_>,
    informations: &[DMatrix<f64>],
    candidate_readings: &[Observation],
    chosen: &mut [usize],
) {
    let allowed = contest.closeness(&sum(informations, chosen)) + GIVEN_FOR_SIMPLICITY;
    for k in 0..chosen.len() {
        let rest = sum(informations, chosen) - &informations[chosen[k]];
        let simpler = |i: &usize| effort(&candidate_readings[*i]) < effort(&candidate_readings[chosen[k]]);
        let kept = |i: &usize| contest.closeness(&(&rest + &informations[*i])) <= allowed;
        if let Some(other) = (0..candidate_readings.len())
            .filter(simpler)
            .filter(kept)
            .min_by_key(|i| effort(&candidate_readings[*i]))
        {
            chosen[k] = other;
        }
    }
}

/// The reading that adds most to the smallest distance beside the information there is; the first of equals.
fn best(contest: &Contest<'_>, informations: &[DMatrix<f64>], rest: &DMatrix<f64>) -> (usize, f64) {
    let bounds: Vec<f64> = parallel::map(informations, |m| contest.closeness(&(rest + m)));
    let least = bounds.iter().enumerate().reduce(|a, b| if b.1 < a.1 { b } else { a });
    least.map_or((0, f64::INFINITY), |(i, b)| (i, *b))
}

fn sum(informations: &[DMatrix<f64>], chosen: &[usize]) -> DMatrix<f64> {
    let n = informations.first().map_or(0, DMatrix::nrows);
    chosen.iter().fold(DMatrix::zeros(n, n), |sum, &i| sum + &informations[i])
}

/// Puts the aspects without which a reading separates much less into words.
fn say(
    contest: &Contest<'_>,
    space: &Space,
    hexapod: &Hexapod,
    total: &DMatrix<f64>,
    own: &[&DMatrix<f64>],
    readings: &mut [PlannedReading],
) -> Result<(), DesignError> {
    let Some(first) = space.settings().first().map(|s| crate::regressor::reading(Pose::default(), s)) else {
        return Ok(());
    };
    let waits = &space.conditions.waits;
    let ends =
        [waits.iter().copied().fold(f64::INFINITY, f64::min), waits.iter().copied().fold(0.0, f64::max)];
    let ordinary = Ordinary::new(first, ends);
    let half = std::array::from_fn(|k| 0.5 * (space.high[k] - space.low[k]));
    for (reading, own) in readings.iter_mut().zip(own) {
        let without: Vec<(Aspect, Observation)> =
            ASPECTS.iter().filter_map(|&a| Some((a, ordinary.without(&reading.observation, a)?))).collect();
        let plain: Vec<Observation> = without.iter().map(|w| w.1).collect();
        if plain.is_empty() {
            continue;
        }
        let rest = total - *own * reading.repeats as f64;
        let before = contest.closeness(&rest);
        let gain = |m: &DMatrix<f64>| before - contest.closeness(&(&rest + m * reading.repeats as f64));
        let kept = contest.informations(&plain)?;
        let matters: Vec<Aspect> = without
            .iter()
            .zip(&kept)
            .filter(|(_, m)| gain(m) < MATTERS * gain(own))
            .map(|(w, _)| w.0)
            .collect();
        reading.words = ordinary.phrase(hexapod, &half, &reading.observation, &matters);
    }
    Ok(())
}
