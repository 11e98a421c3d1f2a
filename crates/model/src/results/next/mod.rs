//! The next measurements: the readings that best separate the explanations that remain.
//!
//! An explanation is a fitted model with what is known of its parameters (springs and effects) and of its inputs (joints, loads and
//! axes, to their tolerances), so readings separate it from another only by what neither can refit. Readings are chosen one after the other, each beside those chosen before, out of a
//! candidate readings of round numbers; the same one may be chosen again.

mod belief;
mod candidate_readings;
mod choice;
mod filter;
mod forms;
mod kind;
mod separation;
mod suspects;
mod visible;
mod words;

use hexbench_core::Observation;
use hexbench_core::parallel;

pub use self::choice::Between;
pub use self::kind::{effort, snapped, step};
pub use self::separation::Separation;
pub use self::suspects::{Suspects, suspects};
pub use self::visible::detectable_after;
pub use self::words::{ASPECTS, Aspect, MATTERS, Ordinary};

use self::belief::as_plan;
use self::choice::Choice;
use self::forms::{Expectations, Hardest};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;

/// Odds at which an explanation counts as excluded.
pub const EXCLUDED_ODDS: f64 = 20.0;
/// Odds at which no more readings are asked for: what is expected of readings and what they then say differ, and effects that
/// nobody thought of want to be excluded too.
const ENOUGH_ODDS: f64 = 1000.0;
/// Readings asked for at least: one alone cannot be checked.
const FEWEST: usize = 2;
/// A reading that lowers the bound on wrong decisions by less than this (logarithm) is not worth taking.
const WORTHWHILE: f64 = 0.02;

/// One explanation of the data in hand.
#[derive(Debug, Clone)]
pub struct RivalExplanation {
    /// Ids of its effects; none for springs alone.
    pub terms: Vec<String>,
    /// Its probability, up to a common factor.
    pub weight: f64,
    /// Its fit to the data in hand.
    pub fit: Fit,
    /// Other forms of it that the data leave open.
    pub forms: Vec<RivalForm>,
}

/// Another form of an explanation: a version, the richer form, a shape to which no fit leads from the first one.
#[derive(Debug, Clone)]
pub struct RivalForm {
    /// Its fit to the data in hand.
    pub fit: Fit,
    /// How many times as probable it is as the first form.
    pub odds: f64,
}

/// A reading to take.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// What to set.
    pub observation: Observation,
    /// How often to read it.
    pub repeats: usize,
    /// The explanations it separates most.
    pub between: Between,
    /// What it adds to the mean logarithm of the Bayes factor between them, beside the readings before it, under the one of the
    /// two for which that is less; nats.
    pub gain: f64,
    /// What sort of reading it is.
    pub words: String,
}

/// How well two explanations will be separated.
#[derive(Debug, Clone, PartialEq)]
pub struct PairForecast {
    /// Which.
    pub between: Between,
    /// By all proposed readings together.
    pub separation: Separation,
    /// Readings, of those proposed, after which the wrong one is on average excluded at [`EXCLUDED_ODDS`], whichever is wrong.
    pub readings_needed: Option<usize>,
}

/// Readings to take, and what they promise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProposedReadings {
    /// The readings, in the order in which they were chosen.
    pub proposals: Vec<Proposal>,
    /// Every pair of explanations.
    pub forecasts: Vec<PairForecast>,
}

impl ProposedReadings {
    /// Every reading, as often as it is taken.
    pub fn one_by_one(&self) -> Vec<Observation> {
        self.proposals.iter().flat_map(|p| std::iter::repeat_n(p.observation, p.repeats)).collect()
    }

    /// Readings with their repeats.
    pub fn readings(&self) -> usize {
        self.proposals.iter().map(|p| p.repeats).sum()
    }
}

/// How many readings to choose.
#[derive(Clone, Copy)]
pub enum Effort<'a> {
    /// As many as exclude what is wrong, but no more than so many.
    UpTo(usize),
    /// So many, as long as each is of some use.
    Exactly(usize),
    /// No more than so many, as long as each is of some use and they are together within what is allowed.
    Within(usize, &'a dyn Fn(&[Observation]) -> bool),
}

/// Readings of the campaign's own kind to choose from.
///
/// # Errors
/// [`ModelError::SingularPose`].
pub fn candidate_readings(
    campaign: &Campaign,
    rivals: &[RivalExplanation],
) -> Result<Vec<Observation>, ModelError> {
    if rivals.is_empty() {
        return Ok(Vec::new());
    }
    let fits: Vec<&Fit> = rivals.iter().map(|r| &r.fit).collect();
    candidate_readings::candidate_readings(campaign, &fits)
}

/// The readings out of `candidate_readings` that best separate the rivals.
///
/// # Errors
/// [`ModelError::SingularPose`], [`ModelError::TooFewEquations`] for an empty list.
pub fn propose(
    campaign: &Campaign,
    rivals: &[RivalExplanation],
    candidate_readings: &[Observation],
    effort: Effort<'_>,
) -> Result<ProposedReadings, ModelError> {
    if rivals.len() < 2 {
        return Ok(ProposedReadings::default());
    }
    let plan = as_plan(campaign, candidate_readings)?;
    let expected = Expectations::of(&plan, campaign, rivals)?;
    let chosen = chosen(&plan, &expected, effort);
    let taken: Vec<usize> = chosen.iter().map(|c| c.0).collect();
    let pairs = hardest_of_pairs(&expected, rivals.len(), &taken);
    let gain = |k: usize, between: Between| {
        let hardest = pairs.iter().find(|(pair, _)| *pair == between);
        let after = |k: usize| hardest.and_then(|(_, h)| h.course.get(k)).map_or(0.0, |d| least(*d));
        after(k) - if k > 0 { after(k - 1) } else { 0.0 }
    };
    let mut proposals: Vec<Proposal> = Vec::new();
    for (k, &(reading, between)) in chosen.iter().enumerate() {
        let observation = plan.groups[reading].mean;
        if let Some(known) = proposals.iter_mut().find(|p| p.observation == observation) {
            known.repeats += 1;
            known.gain += gain(k, known.between);
        } else {
            let gain = gain(k, between);
            proposals.push(Proposal { observation, repeats: 1, between, gain, words: String::new() });
        }
    }
    say(campaign, rivals, &mut proposals)?;
    Ok(ProposedReadings { proposals, forecasts: promised(pairs) })
}

/// How well given readings, each as often as it is listed and in this order, would separate every pair of rivals.
///
/// # Errors
/// As [`propose`].
pub fn forecasts(
    campaign: &Campaign,
    rivals: &[RivalExplanation],
    readings: &[Observation],
) -> Result<Vec<PairForecast>, ModelError> {
    let plan = as_plan(campaign, readings)?;
    let expected = Expectations::of(&plan, campaign, rivals)?;
    Ok(promised(hardest_of_pairs(&expected, rivals.len(), &places(&plan, readings.len()))))
}

/// Every pair of rivals, and what readings promise about it.
fn hardest_of_pairs(expected: &Expectations, rivals: usize, readings: &[usize]) -> Vec<(Between, Hardest)> {
    let pairs: Vec<Between> = (0..rivals).flat_map(|a| (a + 1..rivals).map(move |b| [a, b])).collect();
    parallel::filter_map(&pairs, |&pair| Some((pair, expected.hardest(pair, readings)?)))
}

fn promised(pairs: Vec<(Between, Hardest)>) -> Vec<PairForecast> {
    let forecast = |(between, Hardest { separation, course })| PairForecast {
        between,
        separation,
        readings_needed: needed(&course),
    };
    pairs.into_iter().map(forecast).collect()
}

/// Places in the candidate readings, with the pair of rivals each separates most.
fn chosen(plan: &Campaign, expected: &Expectations, effort: Effort<'_>) -> Vec<(usize, Between)> {
    let simplicity: Vec<usize> = plan.groups.iter().map(|g| kind::effort(&g.mean)).collect();
    let mut choice = Choice::new(expected);
    let (Effort::UpTo(most) | Effort::Exactly(most) | Effort::Within(most, _)) = effort;
    let mut chosen: Vec<(usize, Between)> = Vec::new();
    while chosen.len() < most {
        let Some((reading, _)) = choice.best(&simplicity).filter(|(_, drop)| *drop > WORTHWHILE) else {
            break;
        };
        let Some(between) = choice.separated_most(reading) else { break };
        chosen.push((reading, expected.rivals(between)));
        let taken: Vec<usize> = chosen.iter().map(|c| c.0).collect();
        match effort {
            Effort::UpTo(_) if taken.len() >= FEWEST && are_excluded(expected, &taken) => break,
            Effort::Within(_, allowed)
                if !allowed(&taken.iter().map(|&k| plan.groups[k].mean).collect::<Vec<_>>()) =>
            {
                chosen.pop();
                break;
            }
            _ => {}
        }
        choice.choose(reading);
    }
    chosen
}

/// True when readings exclude what is wrong, whatever is.
fn are_excluded(expected: &Expectations, readings: &[usize]) -> bool {
    let is_done = |&forms: &Between| {
        expected.log_bayes_factor(forms, readings).is_some_and(|d| least(d) >= ENOUGH_ODDS.ln())
    };
    expected.pairs().iter().all(is_done)
}

fn least(log_bayes_factor: [f64; 2]) -> f64 {
    log_bayes_factor[0].min(log_bayes_factor[1])
}

fn needed(course: &[[f64; 2]]) -> Option<usize> {
    course.iter().position(|&d| least(d) >= EXCLUDED_ODDS.ln()).map(|k| k + 1)
}

/// Place of every reading among those of a plan, which holds equal ones once.
fn places(plan: &Campaign, readings: usize) -> Vec<usize> {
    let mut places = vec![0; readings];
    for (place, group) in plan.groups.iter().enumerate() {
        group.rows.iter().for_each(|&row| places[row as usize] = place);
    }
    places
}

/// Puts the aspects that matter into words.
fn say(
    campaign: &Campaign,
    rivals: &[RivalExplanation],
    proposals: &mut [Proposal],
) -> Result<(), ModelError> {
    let Some(ordinary) = Ordinary::of(campaign).filter(|_| !proposals.is_empty()) else { return Ok(()) };
    let mut readings: Vec<Observation> = proposals.iter().map(|p| p.observation).collect();
    let mut plain: Vec<(usize, Aspect, usize)> = Vec::new();
    for (k, p) in proposals.iter().enumerate() {
        for aspect in ASPECTS {
            let Some(o) = ordinary.without(&p.observation, aspect) else { continue };
            let known = readings.iter().position(|r| *r == o);
            plain.push((k, aspect, known.unwrap_or(readings.len())));
            if known.is_none() {
                readings.push(o);
            }
        }
    }
    let half = candidate_readings::half_ranges(campaign);
    let plan = as_plan(campaign, &readings)?;
    let place = places(&plan, readings.len());
    let mut choice = Choice::new(&Expectations::of(&plan, campaign, rivals)?);
    for (k, p) in proposals.iter_mut().enumerate() {
        let own = choice.drop(place[k]);
        let matters: Vec<Aspect> = plain
            .iter()
            .filter(|(of, _, without)| *of == k && choice.drop(place[*without]) < MATTERS * own)
            .map(|(_, aspect, _)| *aspect)
            .collect();
        p.words = ordinary.phrase(&campaign.hexapod, &half, &p.observation, &matters);
        (0..p.repeats).for_each(|_| choice.choose(place[k]));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_enough_once_the_worse_of_both_odds_is_twenty_to_one() {
        let odds = |a: f64, b: f64| [a.ln(), b.ln()];
        let course = [odds(2.0, 5e4), odds(19.0, 5e4), odds(1e6, 21.0), odds(1e7, 1e7)];
        assert_eq!(needed(&course), Some(3));
        assert_eq!(needed(&course[..2]), None);
    }
}
