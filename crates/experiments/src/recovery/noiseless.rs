//! Recovery without noise, against a bound that follows from what the model linearizes.
//!
//! Least squares carry an error `d` of the predicted readings (whitened, all conditions in one vector) into a parameter by a
//! row of the pseudo-inverse, whose length is the parameter's standard uncertainty. By Cauchy and Schwarz, whatever the
//! direction of the error,
//!
//! ```text
//! |estimate - truth| <= std |d|
//! ```
//!
//! What remains in `d`: let `nu` be the relative change of the leg Jacobian between the commanded pose and the loaded (or the
//! reference) pose, `nu = |H J (L - L_cmd) H^-1|` for motions and likewise for forces (the larger of the two, both in the
//! measure of the readings), of order load / (k leg length). The model takes forces where they act (one
//! step of refinement leaves `nu^2` of them) and linearizes the motion halfway between the two states (which leaves `nu^2 / 24`
//! and less of it): springs are right to *second* order. It knows where the reference state is only by the springs, and takes
//! effects where the machine was commanded: what an effect adds is right to *first* order, and so is the response of the
//! springs to it. With `s` the length of the springs' response to load and reference and `e` that of the effect,
//!
//! ```text
//! |d_i| <= nu_i^2 s_i + (nu_i + u_i / travel + t_i) e_i
//! ```
//!
//! `u / travel`, deflection over leg travel, is there for effects that follow the leg length; `t` is the part in which the
//! forms of world and model differ: the world's drift of Euler angles and the model's turn about fixed axes, `|E(angles) - I|`.
//!
//! Absolute poses have no linearization to be wrong: at the measured pose the closure `q(pose) - q_commanded = e` is exact, in
//! the world as in the model. What remains is rounding of lengths, and that is their bound; it proves nothing on independence.

use hexbench_core::{Metrology, Pose, Vector6};
use hexbench_model::estimation::campaign::{self, Condition};
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::machine::kinematics::euler_rate_matrix;
use nalgebra::{DMatrix, Matrix3, Matrix6};
use serde::{Deserialize, Serialize};

use super::geometry::combinations;
use super::pulls::{Pull, PullGroup, pulls, right_fit};
use super::scene::{HiddenSubject, RecoveryCampaign};
use crate::TrialError;

/// Noise stated to the fit of ideal readings: so small that it goes on until its steps are rounding, and that no prior is
/// heard.
pub(crate) const NO_NOISE: Metrology = Metrology { sigma_translation: 1e-12, sigma_rotation: 6e-12 };
/// Roundings of one leg length between world and model: pose, rotation, frames, closure.
const ROUNDINGS: f64 = 64.0;

/// An error with its bound; of several, the one closest to its bound.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Bounded {
    /// Relative error.
    pub error: f64,
    /// What the linearization allows.
    pub bound: f64,
}

impl Bounded {
    /// True when the error is within its bound.
    pub fn holds(&self) -> bool {
        self.error <= self.bound
    }

    /// The one closer to its bound.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        if other.error * self.bound > self.error * other.bound { other } else { self }
    }
}

/// Errors of a fit to ideal readings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Noiseless {
    /// Leg stiffness.
    pub stiffness: Option<Bounded>,
    /// Sizes and shapes of the effects.
    pub effect: Option<Bounded>,
}

/// Fits ideal readings by the right model.
pub(crate) fn recover(subject: &HiddenSubject, scene: &RecoveryCampaign) -> Result<Noiseless, TrialError> {
    let data = scene.ideal_of_same_form()?;
    let (campaign, fit) = right_fit(subject, &scene.hexapod_stating(Some(NO_NOISE)), &data)?;
    let lin = Linearization::at(&campaign, &fit.point)?;
    let error =
        if subject.absolute { rounding(&lin) } else { linearization_error(&lin, &fit, &campaign.groups) };
    let of = |group: fn(PullGroup) -> bool| {
        let all = pulls(scene, &fit).into_iter().filter(|p| group(p.known.group));
        all.map(|p| bounded(&p, error)).reduce(Bounded::worse)
    };
    let effect = match combinations(scene, &fit) {
        None => of(|g| g != PullGroup::Stiffness),
        Some(found) => found.misses.iter().map(|m| combined(m, error)).reduce(Bounded::worse),
    };
    Ok(Noiseless { stiffness: of(|g| g == PullGroup::Stiffness), effect })
}

/// Relative error of one number, and `std |d|` in the same measure.
fn bounded(pull: &Pull, error: f64) -> Bounded {
    let truth = pull.known.value.abs();
    Bounded {
        error: (pull.estimate.value - pull.known.value).abs() / truth,
        bound: pull.estimate.std * error / truth,
    }
}

/// The same of a combination of geometry numbers.
fn combined([miss, std]: &[f64; 2], error: f64) -> Bounded {
    Bounded { error: miss.abs(), bound: std * error }
}

/// `|d|` of a campaign of deflections.
fn linearization_error(lin: &Linearization, fit: &Fit, groups: &[campaign::ConditionReadings]) -> f64 {
    let readers = lin.elongation_readers();
    let effects = effect_lengths(lin, fit);
    let travel = travel(lin);
    let of = |i: usize| {
        let at = &lin.conditions[i];
        let [both, change] = responses(&readers[i], fit, at);
        let by_force = readers[i] * Matrix6::from_diagonal(&fit.point.compliances);
        let (nu, moved) = jacobian_change(lin, at, &groups[i].mean.pose, &by_force);
        let loose = nu + moved / travel + form(fit, at);
        // An effect acts in both states; its column is the difference of the two.
        nu * nu * both + loose * effects[i] * (both / change).max(1.0)
    };
    (0..lin.conditions.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt()
}

/// Whitened length of what the effects add at every condition, parameter by parameter.
pub(crate) fn effect_lengths(lin: &Linearization, fit: &Fit) -> Vec<f64> {
    let mut all = vec![0.0; lin.conditions.len()];
    for a in &fit.point.active {
        let block = lin.term_block(a.term.as_ref(), a.rich, a.shape);
        all.iter_mut().enumerate().for_each(|(i, length)| *length += length_at(i, &block, &a.values));
    }
    all
}

/// Whitened length of what an effect of these values adds at a condition, parameter by parameter.
pub(crate) fn length_at(condition: usize, block: &DMatrix<f64>, values: &[f64]) -> f64 {
    let column = |k: usize| block.view((6 * condition, k), (6, 1)).norm() * values[k].abs();
    (0..values.len()).map(column).sum()
}

/// Root mean square extension of the legs, m.
fn travel(lin: &Linearization) -> f64 {
    let sum: f64 = lin.conditions.iter().map(|c| c.extension.norm_squared()).sum();
    (sum / (6 * lin.conditions.len()) as f64).sqrt()
}

/// Length of what the springs answer to load and reference at a condition, and of the difference of the two.
pub(crate) fn responses(reader: &Matrix6<f64>, fit: &Fit, at: &Condition) -> [f64; 2] {
    let response = |force: &Vector6| (reader * fit.point.compliances.component_mul(force)).norm();
    let both = response(&at.force) + response(&at.reference_force);
    [both, response(&at.force_change()).max(f64::MIN_POSITIVE)]
}

/// Relative change of the leg Jacobian on the way from the commanded pose, and the largest leg elongation on it, m.
/// `by_force`: whitened reading per leg force.
pub(crate) fn jacobian_change(
    lin: &Linearization,
    at: &Condition,
    commanded: &Pose,
    by_force: &Matrix6<f64>,
) -> (f64, f64) {
    let Ok(start) = lin.machine.legs(commanded) else { return (f64::INFINITY, f64::INFINITY) };
    let reader = at.weights.of(at.observer);
    let size = |metric: &Matrix6<f64>, change: &Matrix6<f64>| {
        let back = metric.try_inverse().unwrap_or_else(Matrix6::zeros);
        (metric * change * back).singular_values().max()
    };
    let motion = at.observer.try_inverse().unwrap_or_else(Matrix6::zeros) * at.reading;
    let ends = [-0.5, 0.5].map(|share| lin.machine.legs(at.place.moved(&motion, share)));
    let change = ends.iter().flatten().map(|end| {
        let change = end.leg_jacobian - start.leg_jacobian;
        let of_motion = size(&reader, &(start.platform_jacobian * change));
        let of_forces = size(by_force, &(start.platform_jacobian.transpose() * change.transpose()));
        (of_motion.max(of_forces), (end.lengths - start.lengths).amax())
    });
    change.fold((0.0, 0.0), |(a, b), (x, y)| (a.max(x), b.max(y)))
}

/// How far the forms of world and model differ at a condition.
fn form(fit: &Fit, at: &Condition) -> f64 {
    let drifts = fit.point.active.iter().any(|a| a.id() == "metrology-drift");
    if drifts { (euler_rate_matrix(&at.place.pose().angles) - Matrix3::identity()).norm() } else { 0.0 }
}

/// `|d|` of absolute poses: lengths rounded, seen as readings.
fn rounding(lin: &Linearization) -> f64 {
    let readers = lin.elongation_readers();
    let of = |i: usize| readers[i].norm() * ROUNDINGS * f64::EPSILON * lin.conditions[i].legs.lengths.max();
    (0..readers.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt()
}
