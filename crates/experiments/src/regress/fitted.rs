//! One noisy campaign through the fit of the right model, in the numbers that limits are made of.

use hexbench_core::statistics::{mean, root_mean_square};
use hexbench_model::estimation::estimate::estimates;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::foreseen::held_out_chance;
use serde::{Deserialize, Serialize};

use super::distance::{PulledDistance, of_effects, of_springs};
use crate::TrialError;
use crate::recovery::campaign::{holdout, is_misfit};
use crate::recovery::geometry::{Combinations, combinations};
use crate::recovery::pulls::{Pull, PullGroup, pulls, right_fit};
use crate::recovery::scene::{HiddenSubject, RecoveryCampaign};

/// Chance of predictions so far off below which they count as missed.
const MISSED: f64 = 0.05;

/// What one campaign shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fitted {
    /// Root mean square of the relative errors of the leg stiffnesses.
    pub stiffness_error: Option<f64>,
    /// Geometric mean of the relative errors of the effect's determined numbers.
    pub effect_error: Option<f64>,
    /// Leg compliances against the truth, in their covariance; `None` in a misfit.
    pub springs: Option<PulledDistance>,
    /// The effect's numbers against the truth, in their covariance; `None` in a misfit.
    pub effect: Option<PulledDistance>,
    /// True when the right model does not fit.
    pub misfit: bool,
    /// Numbers that the data leave open.
    pub open: usize,
    /// Chi-square per degree of freedom of the readings fitted.
    pub chi2_reduced: f64,
    /// Chi-square per number of held-out readings.
    pub holdout: f64,
    /// True when held-out readings are outside the 95 % region of their prediction.
    pub prediction_missed: bool,
    /// Gauss-Newton iterations of the last fit.
    pub iterations: usize,
    /// Points tried in it.
    pub tried: usize,
    /// True when it settled.
    pub settled: bool,
}

impl Fitted {
    /// Draws, fits and compares the `index`-th campaign of a subject.
    ///
    /// # Errors
    /// [`TrialError`] when the campaign cannot be made or fitted.
    pub fn run(subject: &HiddenSubject, index: usize, seed: u64) -> Result<Self, TrialError> {
        let scene = RecoveryCampaign::draw(subject, index, seed, None)?;
        let (campaign, fit) = right_fit(subject, scene.hexapod(), &scene.case.measurements)?;
        let misfit = is_misfit(&fit);
        let all = pulls(&scene, &fit);
        let geometry = combinations(&scene, &fit);
        let believed = |distance: Option<PulledDistance>| distance.filter(|_| !misfit);
        let chance = held_out_chance(&campaign, &scene.case.holdout, &fit)?;
        Ok(Self {
            stiffness_error: stiffness_error(&all),
            effect_error: effect_error(&all, geometry.as_ref()),
            springs: believed(of_springs(&scene, &fit)),
            effect: believed(
                geometry.as_ref().map_or_else(|| of_effects(&scene, &fit), PulledDistance::of_combinations),
            ),
            misfit,
            open: open(&fit, geometry.as_ref()),
            chi2_reduced: fit.chi2_reduced(),
            holdout: holdout(&scene, &campaign, &fit)?,
            prediction_missed: chance < MISSED,
            iterations: fit.effort.iterations,
            tried: fit.effort.tried,
            settled: fit.is_settled(),
        })
    }
}

fn open(fit: &Fit, geometry: Option<&Combinations>) -> usize {
    geometry.map_or_else(|| estimates(fit).not_determined.len(), |g| g.open)
}

fn relative(pull: &Pull) -> f64 {
    (pull.estimate.value / pull.known.value - 1.0).abs()
}

fn stiffness_error(pulls: &[Pull]) -> Option<f64> {
    root_mean_square(pulls.iter().filter(|p| p.known.group == PullGroup::Stiffness).map(relative))
}

fn effect_error(pulls: &[Pull], geometry: Option<&Combinations>) -> Option<f64> {
    let errors: Vec<f64> = match geometry {
        Some(found) => found.misses.iter().map(|[miss, _]| miss.abs()).collect(),
        None => pulls.iter().filter(|p| p.known.group != PullGroup::Stiffness).map(relative).collect(),
    };
    mean(errors.iter().map(|e| e.max(f64::EPSILON).ln())).map(f64::exp)
}
