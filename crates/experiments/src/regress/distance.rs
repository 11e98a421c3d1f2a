//! How far several numbers together lie from the truth, measured in their covariance.
//!
//! `d^2 = m' C^-1 m` of the misses `m` of `n` numbers with covariance `C` follows the chi-square law with `n` degrees of freedom
//! when the covariance is honest: one figure for a campaign, whatever the correlations.

use hexbench_model::estimation::fit::Fit;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::recovery::geometry::Combinations;
use crate::recovery::scene::RecoveryCampaign;

/// Chance of a truth so far off below which it counts as outside the region.
const OUTSIDE: f64 = 0.05;

/// Squared distance of several numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PulledDistance {
    /// `d^2`.
    pub chi2: f64,
    /// How many numbers.
    pub numbers: usize,
}

impl PulledDistance {
    /// Per number: 1 on average when the covariance is honest.
    pub fn per_number(&self) -> f64 {
        self.chi2 / self.numbers as f64
    }

    /// True when the truth is outside the 95 % region.
    pub fn is_outside(&self) -> bool {
        ChiSquared::new(self.numbers as f64).is_ok_and(|law| law.sf(self.chi2) < OUTSIDE)
    }

    /// Both, taken as independent.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { chi2: self.chi2 + other.chi2, numbers: self.numbers + other.numbers }
    }

    /// Of combinations of the geometry, which are uncorrelated as they are.
    pub fn of_combinations(found: &Combinations) -> Option<Self> {
        let chi2 = found.pulls().map(|z| z * z).sum();
        (!found.misses.is_empty()).then_some(Self { chi2, numbers: found.misses.len() })
    }

    /// Of misses by column of the fit; columns that the data leave open are left out.
    fn of(fit: &Fit, misses: &[(usize, f64)]) -> Option<Self> {
        let kept: Vec<&(usize, f64)> =
            misses.iter().filter(|(column, _)| fit.is_determined(*column)).collect();
        let scaled = |i: usize, j: usize| {
            let (a, b) = (kept[i].0, kept[j].0);
            fit.covariance[(a, b)] / (fit.std(a) * fit.std(b))
        };
        let z = DVector::from_fn(kept.len(), |k, _| kept[k].1 / fit.std(kept[k].0));
        let correlation = DMatrix::from_fn(kept.len(), kept.len(), scaled);
        let chi2 = z.dot(&correlation.cholesky()?.solve(&z));
        (!kept.is_empty() && chi2.is_finite()).then_some(Self { chi2, numbers: kept.len() })
    }
}

/// Of the leg compliances, m/N.
pub fn of_springs(scene: &RecoveryCampaign, fit: &Fit) -> Option<PulledDistance> {
    let truth = scene.leg_stiffness().map(f64::recip);
    let misses: Vec<(usize, f64)> =
        (0..6).map(|leg| (leg, fit.point.compliances[leg] - truth[leg])).collect();
    PulledDistance::of(fit, &misses)
}

/// Of the numbers of all effects, SI; a shape enters by its logarithm, as in the covariance.
pub fn of_effects(scene: &RecoveryCampaign, fit: &Fit) -> Option<PulledDistance> {
    let mut misses = Vec::new();
    for (id, truth) in scene.equivalents() {
        let Some(k) = fit.point.active.iter().position(|a| a.id() == id) else { continue };
        let active = &fit.point.active[k];
        let values = fit.parameters.values_of_term(k).zip(active.values.iter().zip(&truth.values));
        misses.extend(values.filter_map(|(column, (value, truth))| Some((column, value - (*truth)?))));
        if let (Some(column), Some(shape)) = (fit.parameters.shape_of_term(k), truth.shape) {
            misses.push((column, (active.shape / shape).ln()));
        }
    }
    PulledDistance::of(fit, &misses)
}
