//! How good the Gaussian is that stands for the posterior of a set of effects: importance sampling.
//!
//! The evidence of a set integrates its likelihood as if readings were linear in its springs, frames and sizes. Draws from that
//! Gaussian, weighed by what the model itself makes of them, say how far this is from the truth:
//!
//! ```text
//! J'J + P = L L',   x = L'^-1 z,   ln w = -(objective(x) - objective(0)) / 2 + z'z / 2,   ln Z - ln Z_Gauss = ln mean w
//! ```
//!
//! with `P` the precision of the priors. The shape `k` of the tail of the weights says whether that mean can be relied on: below 0.7 it
//! can. Shapes are summed over a grid in the evidence and stay where they are here. Sources: Vehtari, Simpson, Gelman, Yao and Gabry
//! 2024, JMLR 25(72); Zhang and Stephens 2009, Technometrics 51 (fit of the tail).

use std::ops::Range;

use hexbench_core::parallel;
use hexbench_core::streams::{Purpose, stream};
use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rand_distr::StandardNormal;
use serde::Serialize;

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, columns, fit};
use crate::estimation::linearization::{Linearization, own_residuals};
use crate::estimation::parameters::ParameterPlace;
use crate::inference::candidates::CandidateKind;
use crate::inference::diagnosis::RankedSets;
use crate::inference::search::Set;

/// Draws for each set.
const DRAWS: u64 = 64;
/// Draws that tell whether the others are needed.
const FIRST_DRAWS: u64 = 16;
/// Logarithms of their weights, nats, up to which the others are not: the model bends by so little that no weight will matter.
const NEGLIGIBLE: f64 = ALIKE / 5.0;
/// Sets looked at: the best, and those nearest to it.
const MOST_SETS: usize = 3;
/// Sets this many nats below the best do not matter.
const MATTERS: f64 = 2.0;
/// With more conditions the draws would cost more than the search, and the posterior is as narrow as it is Gaussian.
const MOST_CONDITIONS: usize = 300;
/// Largest shape of the tail with which a mean of weights can be relied on.
const RELIABLE_K: f64 = 0.7;
/// Evidence that is off by this much matters, nats: odds by a factor of 2.7.
const OFF: f64 = 1.0;
/// Largest weights over the middle one below which all are alike, nats: whatever their tail, it decides nothing.
const ALIKE: f64 = 0.25;

/// What the draws say of one set.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct GaussianCheck {
    /// Effects of the set.
    pub terms: Vec<String>,
    /// Draws that were weighed.
    pub draws: usize,
    /// Shape of the tail of their weights (Pareto k); absent where all weights are alike.
    pub pareto_k: Option<f64>,
    /// What the logarithm of the evidence lacks, by their mean.
    pub log_evidence_change: f64,
}

impl GaussianCheck {
    /// True when probabilities that rest on the Gaussian are not to be relied on.
    pub fn is_off(&self) -> bool {
        self.log_evidence_change.abs() > OFF || self.is_heavy()
    }

    /// True when few draws decide their mean.
    pub fn is_heavy(&self) -> bool {
        self.pareto_k.is_some_and(|k| k > RELIABLE_K)
    }
}

/// The leading sets of a search, the best first; nothing for large campaigns, where effects have no probability, and for absolute
/// poses: their joints move along with the frames in twelve ways that no reading fixes, which belong to every set.
pub fn gaussian_checks(campaign: &Campaign, outcome: &RankedSets) -> Vec<GaussianCheck> {
    let Some(best) = outcome.sets.sets.first() else { return Vec::new() };
    let is_large = campaign.groups.len() > MOST_CONDITIONS;
    if is_large || !campaign.noise.allows_verdict() || campaign.is_absolute() {
        return Vec::new();
    }
    let is_listed = |set: &&Set| {
        set.members.iter().all(|&m| matches!(outcome.candidates[m].kind, CandidateKind::Term(_)))
    };
    let close = |set: &&Set| set.log_weight > best.log_weight - MATTERS && !set.members.is_empty();
    let leading: Vec<&Set> =
        outcome.sets.sets.iter().filter(is_listed).filter(close).take(MOST_SETS).collect();
    parallel::filter_map(&leading, |set| of_set(campaign, outcome, set).ok()?)
}

fn of_set(campaign: &Campaign, outcome: &RankedSets, set: &Set) -> Result<Option<GaussianCheck>, ModelError> {
    let specs = outcome.wanted(set);
    let terms = specs.iter().map(|s| s.term.info().id.to_owned()).collect();
    let fitted = fit(campaign, &specs, Some(&outcome.best.point))?;
    Ok(log_weights(campaign, &fitted)?.map(|weights| {
        let pareto_k = tail_shape(&weights);
        GaussianCheck { terms, draws: weights.len(), pareto_k, log_evidence_change: log_mean(&weights) }
    }))
}

/// Logarithms of the weights of draws around a fit; none where it has no Gaussian.
fn log_weights(campaign: &Campaign, fitted: &Fit) -> Result<Option<Vec<f64>>, ModelError> {
    let (point, parameters) = (&fitted.point, &fitted.parameters);
    let free: Vec<usize> = (0..parameters.len())
        .filter(|&k| !matches!(parameters[k].place, ParameterPlace::Shape { .. }))
        .collect();
    let lin = Linearization::at(campaign, point)?;
    let own = columns(&lin, point).select_columns(&free);
    let priors = parameters.prior_equations(point).0.select_columns(&free);
    let Some(factor) = (own.tr_mul(&own) + priors.tr_mul(&priors)).cholesky() else { return Ok(None) };
    let here = lin.residuals().norm_squared() + parameters.penalty(point);
    let weight = |draw: u64| {
        let mut rng = stream(0, Purpose::GaussianCheck, [draw]);
        let z = DVector::from_fn(free.len(), |_, _| rng.sample::<f64, _>(StandardNormal));
        let x = factor.l_dirty().tr_solve_lower_triangular(&z)?;
        let mut increments = vec![0.0; parameters.len()];
        free.iter().zip(x.iter()).for_each(|(&k, step)| increments[k] = *step);
        let there = parameters.moved(point, &increments);
        let own = own_residuals(campaign, &there, |_, reading| *reading).ok()?;
        let left = lin.whitened(DMatrix::from_column_slice(own.len(), 1, own.as_slice()));
        let rise = left.norm_squared() + parameters.penalty(&there) - here;
        Some(0.5 * (z.norm_squared() - rise)).filter(|w| w.is_finite())
    };
    Ok(drawn_until_clear(weight))
}

/// Logarithms of the weights of as many draws as it takes; none where most of them have none.
fn drawn_until_clear(weight: impl Fn(u64) -> Option<f64> + Sync) -> Option<Vec<f64>> {
    let draw = |draws: Range<u64>| parallel::filter_map(&draws.collect::<Vec<_>>(), |&k| weight(k));
    let mut weights = draw(0..FIRST_DRAWS);
    if weights.len() as u64 == FIRST_DRAWS && weights.iter().all(|w| w.abs() < NEGLIGIBLE) {
        return Some(weights);
    }
    weights.extend(draw(FIRST_DRAWS..DRAWS));
    (weights.len() as u64 > DRAWS / 2).then_some(weights)
}

fn log_mean(weights: &[f64]) -> f64 {
    let largest = weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mean = weights.iter().map(|w| (w - largest).exp()).sum::<f64>() / weights.len() as f64;
    largest + mean.ln()
}

/// Shape of a generalised Pareto law through the largest weights, drawn towards 0.5 as far as few of them ask for it.
fn tail_shape(log_weights: &[f64]) -> Option<f64> {
    const TOWARDS: f64 = 0.5;
    const AS_MANY: f64 = 10.0;
    let mut sorted = log_weights.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (count, largest) = (sorted.len(), sorted[sorted.len() - 1]);
    if largest - sorted[count / 2] < ALIKE {
        return None;
    }
    let tail = (count / 5).min((9 * count).isqrt());
    let weight = |w: &f64| (w - largest).exp();
    let cutoff = weight(&sorted[count - tail - 1]);
    let beyond: Vec<f64> =
        sorted[count - tail..].iter().map(|w| (weight(w) - cutoff).max(f64::EPSILON)).collect();
    let n = tail as f64;
    Some((n * pareto_shape(&beyond) + AS_MANY * TOWARDS) / (n + AS_MANY))
}

/// The estimate of Zhang and Stephens of the shape of a generalised Pareto law; `sorted` ascending, above zero.
fn pareto_shape(sorted: &[f64]) -> f64 {
    const PRIOR: f64 = 3.0;
    let n = sorted.len() as f64;
    let points = 30 + sorted.len().isqrt();
    let quartile = sorted[((sorted.len() + 2) / 4).saturating_sub(1)];
    let scale = |j: usize| {
        1.0 / sorted[sorted.len() - 1]
            + (1.0 - (points as f64 / (j as f64 + 0.5)).sqrt()) / (PRIOR * quartile)
    };
    let shape = |b: f64| sorted.iter().map(|x| (-b * x).ln_1p()).sum::<f64>() / n;
    let profile = |b: f64| {
        let k = shape(b);
        n * ((-b / k).ln() - k - 1.0)
    };
    let tried: Vec<(f64, f64)> =
        (0..points).map(scale).map(|b| (b, profile(b))).filter(|(_, l)| l.is_finite()).collect();
    let best = tried.iter().map(|t| t.1).fold(f64::NEG_INFINITY, f64::max);
    let (mut total, mut mean) = (0.0, 0.0);
    for (b, likelihood) in tried {
        let weight = (likelihood - best).exp();
        total += weight;
        mean += weight * b;
    }
    shape(mean / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of a generalised Pareto law with scale 1.
    fn quantiles(shape: f64, count: usize) -> Vec<f64> {
        let at = |i: usize| ((i as f64 + 0.5) / count as f64, shape);
        (0..count).map(at).map(|(p, k)| ((1.0 - p).powf(-k) - 1.0) / k).collect()
    }

    #[test]
    fn a_gaussian_is_off_by_more_than_a_nat_or_where_few_draws_decide() {
        let check = |log_evidence_change, pareto_k| GaussianCheck {
            terms: Vec::new(),
            draws: 64,
            pareto_k,
            log_evidence_change,
        };
        assert!(!check(0.9, Some(0.6)).is_off() && !check(-0.9, None).is_off());
        assert!(check(-1.1, None).is_off() && check(0.0, Some(0.8)).is_off());
    }

    #[test]
    fn a_model_that_hardly_bends_is_not_asked_for_all_draws_and_is_told_the_same() {
        // A cubic in one number, as a third-order term of the model makes it.
        let bent = |by: f64| {
            move |draw: u64| {
                let z: f64 = stream(3, Purpose::GaussianCheck, [draw]).sample(StandardNormal);
                Some(by * z.powi(3))
            }
        };
        let few = drawn_until_clear(bent(NEGLIGIBLE / 30.0)).unwrap();
        let all: Vec<f64> = (0..DRAWS).filter_map(bent(NEGLIGIBLE / 30.0)).collect();
        assert_eq!(few, all[..16]);
        assert_eq!((tail_shape(&few), tail_shape(&all)), (None, None));
        assert!(log_mean(&all).abs() < NEGLIGIBLE && log_mean(&few).abs() < NEGLIGIBLE);
        assert_eq!(drawn_until_clear(bent(0.1)).unwrap().len() as u64, DRAWS);
        assert!(drawn_until_clear(|draw| (draw % 3 == 0).then_some(0.0)).is_none());
    }

    #[test]
    fn the_shape_of_a_pareto_law_is_found_again() {
        for shape in [-0.3, 0.2, 0.5, 1.0, 2.0] {
            let found = pareto_shape(&quantiles(shape, 2_000));
            assert!((found - shape).abs() < 0.05, "{shape}: {found}");
        }
    }

    #[test]
    fn weights_of_a_wider_law_than_the_one_drawn_from_have_a_heavy_tail() {
        // Drawn from a normal law of variance one for one of variance v: ln w = x^2 (1 - 1/v) / 2, of Pareto shape 1 - 1/v.
        let weights = |variance: f64| -> Vec<f64> {
            let draw =
                |i: u64| -> f64 { stream(1, Purpose::GaussianCheck, [i]).sample::<f64, _>(StandardNormal) };
            (0..4_000).map(|i| 0.5 * draw(i).powi(2) * (1.0 - 1.0 / variance) - 0.5 * variance.ln()).collect()
        };
        let [alike, near, far] = [1.0, 1.3, 20.0].map(weights);
        assert_eq!(tail_shape(&alike), None);
        assert!(tail_shape(&near).unwrap() < 0.5);
        assert!(tail_shape(&far).unwrap() > RELIABLE_K);
        assert!(log_mean(&near).abs() < 0.02, "the weights of a law have the mean one: {}", log_mean(&near));
    }

    #[test]
    fn weights_within_a_quarter_of_a_nat_are_alike() {
        let above = |largest: f64| tail_shape(&[vec![0.0; 63], vec![largest]].concat());
        assert!(above(0.24).is_none() && above(0.26).is_some());
        let drawn = |weight: f64| drawn_until_clear(|_| Some(weight)).map(|weights| weights.len() as u64);
        assert_eq!([0.049, 0.051].map(drawn), [Some(FIRST_DRAWS), Some(DRAWS)]);
    }
}
