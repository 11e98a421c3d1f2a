//! One set of effects: read without noise, fitted by the right terms, compared with the truth.

use std::sync::Arc;

use hexbench_core::Observation;
use hexbench_core::streams::{Purpose, derived_seed};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::fit_named;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{CaseKind, CaseSpec, PlanKind, PlanRow};
use hexbench_truth::metrology::InstrumentNoise;
use serde::{Deserialize, Serialize};

use super::second_order::second_order_error;
use crate::TrialError;
use crate::recovery::noiseless::{Bounded, NO_NOISE};
use crate::recovery::pulls::{Known, Pull, PullGroup, known, pulls};
use crate::recovery::scene::RecoveryCampaign;

/// Largest relative error of a leg stiffness.
pub const LARGEST_STIFFNESS_ERROR: f64 = 1e-3;
/// Largest relative error of a parameter of an effect, relative to the largest of those in its unit.
pub const LARGEST_PARAMETER_ERROR: f64 = 3e-3;
/// Family of the machines.
pub(super) const FAMILY: &str = "ring_a";
/// Make of the plans.
pub(super) const PLAN: PlanKind = PlanKind::Rich;

/// What one set of effects gave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InteractionRecord {
    /// Ids of the effects.
    pub effects: Vec<String>,
    /// Their size as a multiple of the usual one.
    pub size: f64,
    /// Leg stiffness with the largest error.
    pub stiffness: Bounded,
    /// Parameter closest to its bound.
    pub parameter: Bounded,
    /// Its name.
    pub name: String,
    /// Numbers that the data leave open.
    pub open: usize,
    /// Readings in which a leg carries nothing and rests anywhere within its play.
    pub resting: usize,
}

impl InteractionRecord {
    /// Draws machine, plan and effects, reads, fits and compares.
    pub(super) fn of(set: &[&'static str], size: f64, seed: u64) -> Result<Self, TrialError> {
        let scene = scene(set, size, seed)?;
        let campaign = Campaign::new(&scene.hexapod_stating(Some(NO_NOISE)), &scene.ideal_of_same_form()?)?;
        let fit = fit_named(&campaign, &terms(set))?;
        let lin = Linearization::at(&campaign, &fit.point)?;
        let second_order = second_order_error(&lin, &fit, &campaign.groups);
        Ok(Self::compared(set, size, &scene, &fit, second_order))
    }

    /// `second_order`: length of the error that the second order of the deflection leaves in the whitened readings.
    fn compared(
        set: &[&'static str],
        size: f64,
        scene: &RecoveryCampaign,
        fit: &Fit,
        second_order: f64,
    ) -> Self {
        let truths = known(scene, fit);
        let found = pulls(scene, fit);
        let worst = |stiffness: bool, least: f64| {
            let own = found.iter().filter(|p| (p.known.group == PullGroup::Stiffness) == stiffness);
            let bounded = own.map(|p| (bounded(p, &truths, least, second_order), p.known.name.clone()));
            bounded.reduce(|a, b| if a.0.worse(b.0) == a.0 { a } else { b }).unwrap_or_default()
        };
        let (parameter, name) = worst(false, LARGEST_PARAMETER_ERROR);
        Self {
            effects: set.iter().map(|id| (*id).to_owned()).collect(),
            size,
            stiffness: worst(true, LARGEST_STIFFNESS_ERROR).0,
            parameter,
            name,
            open: truths.len() - found.len(),
            resting: resting(scene),
        }
    }

    /// True when every number is known and within its bound.
    pub fn holds(&self) -> bool {
        self.open == 0 && self.stiffness.holds() && self.parameter.holds()
    }
}

/// Relative error of a number; `least` is allowed in any case, and what errors of that length in all readings can do to it.
fn bounded(pull: &Pull, truths: &[Known], least: f64, second_order: f64) -> Bounded {
    let measure = measure(&pull.known, truths);
    Bounded {
        error: (pull.estimate.value - pull.known.value).abs() / measure,
        bound: least.max(pull.estimate.std * second_order / measure),
    }
}

/// What an error is relative to: the largest true number of the same effect and kind, since one component of a vector may
/// happen to be next to nothing.
fn measure(one: &Known, all: &[Known]) -> f64 {
    if one.group == PullGroup::Stiffness {
        return one.value;
    }
    let kind = |name: &str| name.rsplit_once('-').map_or(name, |(kind, _)| kind).to_owned();
    let alike = all.iter().filter(|k| k.group == one.group && kind(&k.name) == kind(&one.name));
    alike.map(|k| k.value.abs()).fold(f64::MIN_POSITIVE, f64::max)
}

fn terms(set: &[&'static str]) -> Vec<Arc<dyn Term>> {
    catalogue().into_iter().filter(|t| set.contains(&t.info().id)).collect()
}

/// A machine with these effects, its plan, and its readings.
fn scene(set: &[&'static str], size: f64, seed: u64) -> Result<RecoveryCampaign, TrialError> {
    let name = set.concat().bytes().fold(0_u64, |h, b| h.wrapping_mul(131).wrapping_add(u64::from(b)));
    let spec = CaseSpec {
        id: set.join("+"),
        kind: if set.len() == 1 { CaseKind::Single } else { CaseKind::Pair },
        family: FAMILY,
        plan: PLAN,
        effects: set.to_vec(),
        distance: None,
        noise: InstrumentNoise::default(),
        seed: derived_seed(seed, Purpose::InteractionCase, [name]) & u64::from(u32::MAX),
    };
    let mut case = spec.build()?;
    for mechanism in &mut case.campaign.world.mechanisms {
        *mechanism = mechanism.scaled(size);
    }
    Ok(RecoveryCampaign { case })
}

/// Readings in which a leg rests within its play: a state that the model, whose legs push or pull, does not have.
fn resting(scene: &RecoveryCampaign) -> usize {
    let world = &scene.case.campaign.world;
    let rests = |o: &&Observation| {
        world.reading(&PlanRow::from(*o).situation).is_ok_and(|r| r.equilibrium.forces.contains(&0.0))
    };
    scene.case.measurements.observations.iter().filter(rests).count()
}
