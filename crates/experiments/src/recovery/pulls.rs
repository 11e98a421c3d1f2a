//! Pulls: how far estimates lie from the truth in their own standard uncertainties.

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::estimate::{Estimate, estimates};
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::fit_named;
use hexbench_model::estimation::parameters::{parameter_names, stiffness_name};

use super::scene::{HiddenSubject, RecoveryCampaign};

/// A number of the truth under the name and in the unit of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// As in `Estimate::name`.
    pub name: String,
    /// In the unit of the estimate.
    pub value: f64,
    /// What kind of number.
    pub group: PullGroup,
}

/// Kinds of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PullGroup {
    /// Stiffness of a leg.
    Stiffness,
    /// Linear size of an effect.
    Size,
    /// Exponent, time constant, period.
    Shape,
}

/// The truth of a scene under the model's names; numbers without counterpart are left out.
pub fn known(scene: &RecoveryCampaign, fit: &Fit) -> Vec<Known> {
    const PER_SI: f64 = 1e-6;
    let mut all: Vec<Known> = scene
        .leg_stiffness()
        .iter()
        .enumerate()
        .map(|(i, k)| Known { name: stiffness_name(i), value: k * PER_SI, group: PullGroup::Stiffness })
        .collect();
    for (id, truth) in scene.equivalents() {
        let Some(active) = fit.point.active.iter().find(|a| a.id() == id) else { continue };
        for ((name, _, per_si), value) in parameter_names(active).iter().zip(&truth.values) {
            let Some(value) = value else { continue };
            all.push(Known { name: format!("{id}.{name}"), value: value * per_si, group: PullGroup::Size });
        }
        let shape = active.term.info().shape.filter(|_| !active.term.shape_is_parameter());
        if let (Some(shape), Some(value)) = (shape, truth.shape) {
            all.push(Known {
                name: format!("{id}.{}", shape.name),
                value: value * shape.per_si,
                group: PullGroup::Shape,
            });
        }
    }
    all
}

/// One estimate beside its truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Pull {
    /// The truth.
    pub known: Known,
    /// The estimate.
    pub estimate: Estimate,
}

impl Pull {
    /// Estimate minus truth in standard uncertainties. A shape is fitted by its logarithm: its interval is a factor.
    pub fn z(&self) -> f64 {
        let Estimate { value, std, .. } = self.estimate;
        match self.known.group {
            PullGroup::Shape => (value / self.known.value).ln() / (std / value),
            _ => (value - self.known.value) / std,
        }
    }
}

/// Every determined estimate beside its truth.
pub fn pulls(scene: &RecoveryCampaign, fit: &Fit) -> Vec<Pull> {
    let found = estimates(fit).determined;
    let pull = |known: Known| {
        let estimate = found.iter().find(|e| e.name == known.name)?.clone();
        Some(Pull { known, estimate })
    };
    known(scene, fit).into_iter().filter_map(pull).collect()
}

/// The fit of the right model: effects follow the laws of the world.
///
/// # Errors
/// As `fit_named`.
pub fn right_fit(
    subject: &HiddenSubject,
    hexapod: &Hexapod,
    data: &Dataset,
) -> Result<(Campaign, Fit), ModelError> {
    let campaign = Campaign::new(hexapod, data)?;
    let fit = fit_named(&campaign, &subject.terms())?;
    Ok((campaign, fit))
}
