//! Readings handed over as held out that are none, or of another machine, or written another way.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::numbers::{ALL, Numbers, Scaled};
use super::{Misstatement, MisstatementEntry};
use crate::campaign::{PlanRow, SimulatedCampaign, SimulatedCase, machines, measure};
use crate::metrology::InstrumentFrames;
use crate::{TruthError, World};

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Holdout "holdout-is-training" "The readings held out are those to learn from.", &["holdout", "copies"]
        => HandedOver::Training;
    Holdout "holdout-half-training" "Half of the readings held out are among those to learn from.",
        &["holdout", "copies"] => HandedOver::HalfTraining;
    Holdout "holdout-of-another-machine" "The readings held out are of another machine.", &["holdout"]
        => HandedOver::OtherMachine;
    Holdout "holdout-negated" "The readings held out have the opposite sign.",
        &["holdout", "deflection-sign", "wrench-sign", "states-exchanged"] => Scaled { numbers: Numbers::Reading(ALL), factor: -1.0 };
    Holdout "holdout-mm-as-um" "The readings held out, in mm and mrad, are declared um and urad.",
        &["holdout", "unit"] => Scaled { numbers: Numbers::Reading(ALL), factor: 1e-3 };
];

/// What is handed over.
#[derive(Debug)]
enum HandedOver {
    Training,
    HalfTraining,
    OtherMachine,
}

impl Misstatement for HandedOver {
    fn hold_out(&self, case: &mut SimulatedCase, rng: &mut Pcg64) -> Result<(), TruthError> {
        let learned = &case.measurements.observations;
        match self {
            Self::Training => case.holdout.observations.clone_from(learned),
            Self::HalfTraining => {
                let half = case.holdout.observations.len() / 2;
                for (row, copy) in case.holdout.observations.iter_mut().take(half).zip(learned) {
                    *row = *copy;
                }
            }
            Self::OtherMachine => case.holdout = elsewhere(case, rng)?,
        }
        Ok(())
    }
}

/// The held-out part of the plan on the first machine of another family that can do it.
fn elsewhere(case: &SimulatedCase, rng: &mut Pcg64) -> Result<Dataset, TruthError> {
    let rows: Vec<PlanRow> = case.holdout.observations.iter().map(PlanRow::from).collect();
    let mut on = |family: &str| {
        let world = World::new(machines::draw(family, rng), &machines::leg_stiffness(family, rng));
        let campaign =
            SimulatedCampaign { world, frames: InstrumentFrames::default(), noise: case.spec.noise };
        measure(&campaign, &rows, case.holdout.measurand, &case.holdout.source, rng)
    };
    let mut others = machines::FAMILIES.iter().filter(|family| **family != case.spec.family);
    let first = on(others.next().unwrap_or(&case.spec.family));
    others.fold(first, |made, family| made.or_else(|_| on(family)))
}
