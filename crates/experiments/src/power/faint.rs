//! Effects that never show, whatever their size: springs of other stiffness are the same thing.

use hexbench_core::Vector6;
use hexbench_model::inference::power::{ChiSquareDropLaw, FALSE_ALARM};
use hexbench_truth::Mechanism;
use hexbench_truth::mechanisms::{Creep, LoadMassError};
use serde::Serialize;

use super::simulate::{Bench, Inputs};
use super::{PowerError, PowerPlan};

/// Truths that hide in the springs, in words.
const SOFTER_LEGS: &str = "servo stiffness: every leg 5 % softer";
const MASS_ERROR: &str = "the load is 0.5 kg heavier than stated";
const EQUAL_WAITS: &str = "creep by 5 % (tau 60 s), every reading after 60 s";

/// An effect of the world that hardly leaves anything beside the springs.
#[derive(Debug, Clone, Serialize)]
pub struct Faint {
    /// In words.
    pub what: &'static str,
    /// Share of the signature (its sum of squares) that springs absorb.
    pub absorbed: f64,
    /// Length of the rest in units of the noise.
    pub distance: f64,
    /// Chance that a test made for exactly this rest sees it.
    pub chance: f64,
    /// Change of a leg stiffness, the largest, percent.
    pub bias_percent: f64,
}

/// The effects of this kind under a plan.
///
/// # Errors
/// [`PowerError`].
pub(super) fn faint(plan: &PowerPlan) -> Result<Vec<Faint>, PowerError> {
    const WAIT_S: f64 = 60.0;
    let softer = PowerPlan { stiffness: plan.stiffness.map(|k| 0.95 * k), ..plan.clone() };
    let mut waiting = plan.clone();
    waiting.rows.observations.iter_mut().for_each(|o| o.elapsed = WAIT_S);
    let creep = || -> Box<dyn Mechanism> { Box::new(Creep::new(0.05, WAIT_S)) };
    let heavier = || -> Box<dyn Mechanism> { Box::new(LoadMassError { mass: 0.5 }) };
    Ok(vec![
        one(SOFTER_LEGS, plan, &Bench::new(&softer, 0).ideal(Vec::new())?)?,
        one(EQUAL_WAITS, &waiting, &Bench::new(&waiting, 0).ideal(vec![creep()])?)?,
        one(MASS_ERROR, plan, &Bench::new(plan, 0).ideal(vec![heavier()])?)?,
    ])
}

fn one(what: &'static str, plan: &PowerPlan, ideal: &[Vector6]) -> Result<Faint, PowerError> {
    let bench = Bench::new(plan, 0);
    let plain = bench.ideal(Vec::new())?;
    let rest = |inputs: Inputs| -> Result<f64, PowerError> {
        let [left, nothing] = [ideal, &plain].map(|i| bench.without_noise(i, inputs).map(|found| found.0));
        Ok((left? - nothing?).norm())
    };
    let (_, bias) = bench.without_noise(ideal, Inputs::WithinTolerances)?;
    // Springs absorb the same whatever the inputs are worth; a test sees what tolerances leave.
    let (exact, rest) = (rest(Inputs::Exact)?, rest(Inputs::WithinTolerances)?);
    let whole = bench.length_of_change(ideal)?;
    let law = ChiSquareDropLaw { dof: 1.0, noise_dof: plan.noise.dof };
    Ok(Faint {
        what,
        absorbed: 1.0 - (exact / whole).powi(2),
        distance: rest,
        chance: law.power(law.threshold(FALSE_ALARM), rest * rest),
        bias_percent: super::tables::largest(&bias),
    })
}
