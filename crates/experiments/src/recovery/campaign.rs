//! One noisy campaign through the fit of the right model: pulls, noise, held-out error.

use hexbench_core::Metrology;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, fit_baseline};
use hexbench_model::estimation::foreseen::held_out_chance;
use hexbench_model::estimation::frames::ReadingAxes;
use hexbench_model::estimation::noise::scatter;
use hexbench_model::estimation::residuals::{prediction_errors, summarise};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::geometry::{Combinations, combinations};
use super::noiseless::{Noiseless, recover};
use super::pulls::{Pull, PullGroup, pulls, right_fit};
use super::scene::{HiddenSubject, RecoveryCampaign};
use super::tally::Tally;
use crate::TrialError;

/// Chance of a larger chi-square below which a fit is not believed: its uncertainties are void.
const MISFIT_CHANCE: f64 = 1e-4;

/// What one campaign shows.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CampaignResult {
    /// Recovery without noise.
    pub noiseless: Noiseless,
    /// Pulls of leg stiffnesses.
    pub stiffness: Tally,
    /// Pulls of leg stiffnesses when the noise level comes from the repeats.
    pub stiffness_by_repeats: Tally,
    /// Pulls of sizes; for geometry, of determined combinations.
    pub sizes: Tally,
    /// Pulls of shapes.
    pub shapes: Tally,
    /// True when the right model does not fit.
    pub misfit: bool,
    /// Numbers that the data left open.
    pub open: usize,
    /// Noise level found from repeats within its chi-square interval.
    pub noise_by_repeats: Tally,
    /// Noise level found from residuals within its chi-square interval.
    pub noise_by_residuals: Tally,
    /// Held-out readings within the 95 % region of the prediction.
    pub predicted: Tally,
    /// Held-out chi-square per number with springs alone.
    pub holdout_before: f64,
    /// Held-out chi-square per number with the right model.
    pub holdout_after: f64,
}

/// Draws, fits and compares the `index`-th campaign of a subject.
///
/// # Errors
/// [`TrialError`] when the campaign cannot be made or fitted.
pub fn run(subject: &HiddenSubject, index: usize, seed: u64) -> Result<CampaignResult, TrialError> {
    let scene = RecoveryCampaign::draw(subject, index, seed, None)?;
    let noiseless = recover(subject, &scene)?;
    let data = &scene.case.measurements;
    let (campaign, fit) = right_fit(subject, scene.hexapod(), data)?;
    let misfit = is_misfit(&fit);
    let all = if misfit { Vec::new() } else { pulls(&scene, &fit) };
    let geometry = combinations(&scene, &fit);
    Ok(CampaignResult {
        noiseless,
        stiffness: of(&all, PullGroup::Stiffness),
        stiffness_by_repeats: by_repeats(subject, &scene)?,
        sizes: geometry.as_ref().map_or_else(|| of(&all, PullGroup::Size), of_combinations),
        shapes: of(&all, PullGroup::Shape),
        misfit,
        open: geometry.map_or_else(
            || hexbench_model::estimation::estimate::estimates(&fit).not_determined.len(),
            |g| g.open,
        ),
        noise_by_repeats: noise_by_repeats(&scene),
        noise_by_residuals: Tally::interval(within(fit.chi2, fit.dof)),
        predicted: predicted(&scene, &campaign, &fit)?,
        holdout_before: holdout(&scene, &campaign, &fit_baseline(&campaign)?)?,
        holdout_after: holdout(&scene, &campaign, &fit)?,
    })
}

/// True when a fit is so far from its readings that its uncertainties are void.
pub fn is_misfit(fit: &Fit) -> bool {
    chance_of_larger(fit.chi2, fit.dof) < MISFIT_CHANCE
}

fn of(pulls: &[Pull], group: PullGroup) -> Tally {
    Tally::campaign(pulls.iter().filter(|p| p.known.group == group).map(Pull::z))
}

fn of_combinations(found: &Combinations) -> Tally {
    Tally::campaign(found.pulls())
}

/// Leg stiffnesses when no noise level is stated and the repeats have to tell it.
fn by_repeats(subject: &HiddenSubject, scene: &RecoveryCampaign) -> Result<Tally, ModelError> {
    let (_, fit) = right_fit(subject, &scene.hexapod_stating(None), &scene.case.measurements)?;
    Ok(of(&pulls(scene, &fit), PullGroup::Stiffness))
}

/// Levels of translations and of rotations against the truth.
fn noise_by_repeats(scene: &RecoveryCampaign) -> Tally {
    let found = scatter(&scene.case.measurements, &ReadingAxes::default());
    let Metrology { sigma_translation, sigma_rotation } = scene.noise().metrology();
    let chi2 = |variance: f64, sigma: f64| variance / (sigma * sigma) * found.dof;
    Tally::interval(within(chi2(found.variance_translation, sigma_translation), found.dof))
        .and(Tally::interval(within(chi2(found.variance_rotation, sigma_rotation), found.dof)))
}

/// True when the 95 % interval of a noise level that gives this chi-square holds the true level.
fn within(chi2: f64, dof: f64) -> bool {
    (0.025..=0.975).contains(&chance_of_larger(chi2, dof))
}

fn chance_of_larger(chi2: f64, dof: f64) -> f64 {
    ChiSquared::new(dof.max(1.0)).map_or(f64::NAN, |law| law.sf(chi2))
}

/// One-sided: predictions fail by being too far away.
fn predicted(scene: &RecoveryCampaign, campaign: &Campaign, fit: &Fit) -> Result<Tally, ModelError> {
    let chance = held_out_chance(campaign, &scene.case.holdout, fit)?;
    Ok(Tally::interval(chance >= 0.05))
}

/// Held-out chi-square per number.
pub(crate) fn holdout(scene: &RecoveryCampaign, campaign: &Campaign, fit: &Fit) -> Result<f64, ModelError> {
    let errors = prediction_errors(scene.hexapod(), &scene.case.holdout, campaign.noise, &fit.point)?;
    Ok(summarise(&errors, None).chi2_reduced)
}
