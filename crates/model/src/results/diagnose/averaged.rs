//! Leg compliances averaged over the explanations that remain: where rivals disagree about what the springs absorb, their
//! distance belongs to the uncertainty.
//!
//! The posterior of a compliance is a mixture of one Gaussian per set of effects, weighted with the probability of the set
//! (Hoeting et al. 1999, Statistical Science 14). Its tails are heavy: an improbable set may leave a spring wide open. So its
//! center is the median, and its standard uncertainty a share `1 / 1.96` of the half-width about the median that holds 95 %,
//! as in a coverage interval (JCGM 101:2008, 7.7), not the root of the variance.

use hexbench_core::Vector6;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::estimation::estimate::LegCompliances;
use crate::estimation::fit::Fit;
use crate::inference::diagnosis::RankedSets;
use crate::inference::evidence::Variant;

/// Probability of the interval.
const COVERAGE: f64 = 0.95;
/// Its half-width in standard deviations of a Gaussian.
const COVERAGE_FACTOR: f64 = 1.959_963_984_540_054;
/// Sets of a smaller share move neither the median nor the interval.
const SMALLEST_SHARE: f64 = 1e-3;
/// Bisections: from any bracket to more digits than are printed.
const BISECTIONS: usize = 40;

/// Springs of a fit of the terms of the best set, averaged over all sets. The sets are linear about that fit; what its own
/// variance has beyond the linear one (shapes) stays.
pub(super) fn averaged_springs(outcome: &RankedSets, last: &Fit) -> LegCompliances {
    let own = LegCompliances::of(last);
    let Some(fitted) = outcome.gram.springs(&fitted(outcome)) else { return own };
    let curved = (own.variance - fitted.1).map(|v| v.max(0.0));
    let (mut weights, mut springs) = (Vec::new(), Vec::new());
    for set in &outcome.sets.sets {
        let weight = outcome.sets.probability(set) + outcome.sets.discrepant_probability(set);
        let known = outcome.gram.springs(&set.variants).filter(|_| weight > SMALLEST_SHARE);
        if let Some((shift, variance)) = known {
            weights.push(weight);
            springs.push((own.compliance + shift - fitted.0, (variance + curved).map(f64::sqrt)));
        }
    }
    let of_leg = |leg: usize| {
        let parts = weights.iter().zip(&springs).map(|(w, (c, std))| (*w, c[leg], std[leg]));
        Mixture(parts.collect()).centre_and_std()
    };
    let legs: [(f64, f64); 6] = std::array::from_fn(of_leg);
    let compliance = Vector6::from_fn(|leg, _| legs[leg].0);
    let variance = Vector6::from_fn(|leg, _| legs[leg].1.powi(2));
    LegCompliances { compliance, variance, determined: own.determined }
}

/// Variants of the terms of the best set; a pattern is no part of a fit.
fn fitted(outcome: &RankedSets) -> Vec<Variant> {
    let Some(best) = outcome.sets.sets.first() else { return Vec::new() };
    let members = best.members.iter().zip(&best.variants);
    members.filter(|(m, _)| outcome.candidates[**m].id().is_some()).map(|(_, v)| *v).collect()
}

/// Gaussians: weight, mean, standard deviation.
struct Mixture(Vec<(f64, f64, f64)>);

impl Mixture {
    /// Share of the mixture below `x`.
    fn below(&self, x: f64) -> f64 {
        let total: f64 = self.0.iter().map(|p| p.0).sum();
        let share = |&(w, mean, std): &(f64, f64, f64)| w * Normal::standard().cdf((x - mean) / std);
        self.0.iter().map(share).sum::<f64>() / total
    }

    fn centre_and_std(&self) -> (f64, f64) {
        const REACH: f64 = 10.0;
        let low = self.0.iter().map(|p| p.1 - REACH * p.2).fold(f64::INFINITY, f64::min);
        let high = self.0.iter().map(|p| p.1 + REACH * p.2).fold(f64::NEG_INFINITY, f64::max);
        let centre = root(low, high, |x| self.below(x) - 0.5);
        let held = |half: f64| self.below(centre + half) - self.below(centre - half);
        (centre, root(0.0, high - low, |half| held(half) - COVERAGE) / COVERAGE_FACTOR)
    }
}

/// Root of an increasing function.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the distribution function of statrs.
    const DIGITS: f64 = 1e-9;

    #[test]
    fn one_explanation_keeps_its_own_uncertainty() {
        let (centre, std) = Mixture(vec![(0.7, 3.0, 0.25)]).centre_and_std();
        assert!((centre - 3.0).abs() < DIGITS && (std - 0.25).abs() < DIGITS, "{centre} {std}");
    }

    #[test]
    fn the_distance_of_rivals_is_part_of_the_uncertainty() {
        // Two narrow peaks at 0 and 10: from the median in the heavier one, 95 % reaches into the other.
        let (centre, std) = Mixture(vec![(0.8, 0.0, 0.1), (0.2, 10.0, 0.1)]).centre_and_std();
        assert!(centre.abs() < 0.1, "{centre}");
        assert!((9.9..10.1).contains(&(COVERAGE_FACTOR * std)), "{std}");
    }

    #[test]
    fn an_improbable_explanation_that_leaves_a_spring_open_does_not_widen_the_interval() {
        let (_, std) = Mixture(vec![(0.99, 1.0, 0.01), (0.01, 1.0, 10.0)]).centre_and_std();
        assert!((0.0100..0.0125).contains(&std), "{std}");
    }
}
