//! Who is ahead: the mean place over the cases.
//!
//! In every case the programs take places by a score, 1 for the best; equals share theirs, and who says nothing has the last. The
//! mean place needs no unit, no case weighs more than another, and neither silence nor huge uncertainties pay.

use super::EntrantScore;
use super::case::CaseScore;
use super::figures::{Mean, mean};

/// What places are given for.
#[derive(Debug, Clone, Copy)]
struct Discipline {
    /// Its name.
    title: &'static str,
    /// The score of a case, the smaller the better.
    score: fn(&CaseScore) -> Option<f64>,
}

/// All of them.
const DISCIPLINES: [Discipline; 4] = [
    Discipline { title: "leg stiffness", score: |c| c.stiffness.map(|s| s.crps) },
    Discipline { title: "predictions", score: |c| c.prediction.map(|p| p.proper.crps) },
    Discipline {
        title: "diagnoses",
        score: |c| {
            c.outcome.map(|outcome| {
                ["right", "honest", "wrong"].iter().position(|w| *w == outcome).unwrap_or(2) as f64
            })
        },
    },
    Discipline { title: "probabilities", score: |c| c.forecast.map(|f| f.log) },
];

/// Mean places of one program.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanPlaces {
    /// Which program, by its number.
    pub entrant: usize,
    /// Mean place in each discipline that anyone takes part in; none of a program that does not.
    pub of: Vec<Option<f64>>,
    /// Mean place over the cases and disciplines.
    pub all: Mean,
    /// How far behind the best, with the 95 % interval from the differences case by case; none for the best.
    pub behind: Option<(f64, [f64; 2])>,
}

/// Disciplines that anyone takes part in, and the places of all programs, the best first.
pub fn places(entrants: &[EntrantScore]) -> (Vec<&'static str>, Vec<MeanPlaces>) {
    let held: Vec<&Discipline> =
        DISCIPLINES.iter().filter(|d| entrants.iter().any(|e| takes_part(d, e))).collect();
    let of_each: Vec<Vec<Vec<f64>>> = held.iter().map(|d| in_cases(d, entrants)).collect();
    let cases = entrants.first().map_or(0, |e| e.cases.len());
    let over_all = |e: usize| -> Vec<f64> {
        let case = |k: usize| of_each.iter().map(|places| places[e][k]).sum::<f64>() / of_each.len() as f64;
        (0..cases).map(case).collect()
    };
    let all: Vec<Vec<f64>> = (0..entrants.len()).map(over_all).collect();
    let best = (0..all.len()).min_by(|a, b| total(&all[*a]).total_cmp(&total(&all[*b])));
    let one = |e: usize| {
        let of = held
            .iter()
            .zip(&of_each)
            .map(|(d, places)| takes_part(d, &entrants[e]).then(|| total(&places[e]) / cases as f64));
        let behind = best.filter(|best| *best != e).and_then(|best| difference(&all[e], &all[best]));
        Some(MeanPlaces { entrant: e, of: of.collect(), all: mean(&all[e])?, behind })
    };
    let mut found: Vec<MeanPlaces> = (0..entrants.len()).filter_map(one).collect();
    found.sort_by(|a, b| a.all.mean.total_cmp(&b.all.mean));
    (held.iter().map(|d| d.title).collect(), found)
}

fn takes_part(discipline: &Discipline, entrant: &EntrantScore) -> bool {
    entrant.cases.iter().any(|case| (discipline.score)(case).is_some())
}

fn total(places: &[f64]) -> f64 {
    places.iter().sum()
}

/// Places of each program in every case.
fn in_cases(discipline: &Discipline, entrants: &[EntrantScore]) -> Vec<Vec<f64>> {
    let score = |e: &EntrantScore, k: usize| (discipline.score)(&e.cases[k]).unwrap_or(f64::INFINITY);
    let place = |e: &EntrantScore, k: usize| {
        let own = score(e, k);
        let others = || entrants.iter().map(|other| score(other, k));
        let better = others().filter(|s| *s < own).count() as f64;
        let equal = others().filter(|s| s.total_cmp(&own).is_eq()).count() as f64;
        better + 0.5 * (equal + 1.0)
    };
    entrants.iter().map(|e| (0..e.cases.len()).map(|k| place(e, k)).collect()).collect()
}

fn difference(places: &[f64], best: &[f64]) -> Option<(f64, [f64; 2])> {
    let differences: Vec<f64> = places.iter().zip(best).map(|(a, b)| a - b).collect();
    let m = mean(&differences)?;
    Some((m.mean, m.interval()?))
}
