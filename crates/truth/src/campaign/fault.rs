//! A campaign as a laboratory carries it out.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Metrology, Vector6};
use rand_pcg::Pcg64;

use super::measure::read;
use super::{MeasurementPlan, PlanRow, SimulatedCampaign};
use crate::{TruthError, laboratory};

/// What a fault draws for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stage {
    Machine,
    Errors,
    Writing,
    Slips,
}

impl Stage {
    /// The stream of a case or scene, and of a part where parts draw for themselves.
    pub(crate) fn stream(self, seed: u64, part: u64) -> Pcg64 {
        stream(seed, Purpose::CaseFault, [self as u64, part])
    }
}

/// A campaign in the hands of a laboratory.
pub(super) struct Work<'a> {
    /// What it does to the data.
    pub(super) laboratory: &'a laboratory::FaultEntry,
    /// Seed of the case.
    pub(super) seed: u64,
    /// The machine and its instrument.
    pub(super) campaign: SimulatedCampaign,
}

impl Work<'_> {
    /// Makes the machine another than that of the file.
    pub(super) fn alter(&mut self) {
        let mut rng = self.stream(Stage::Machine, 0);
        self.laboratory.fault.alter(&mut self.campaign.world, &mut rng);
    }

    /// What the file states of the instrument.
    pub(super) fn stated(&self) -> Metrology {
        let mut metrology = self.campaign.noise.metrology();
        self.laboratory.fault.state(&mut metrology);
        metrology
    }

    /// Measurements to learn from and to judge by.
    ///
    /// # Errors
    /// As [`World::reading`](crate::World::reading).
    pub(super) fn measure(&self, plan: &MeasurementPlan) -> Result<[Dataset; 2], TruthError> {
        let mut noise = stream(self.seed, Purpose::CaseNoise, []);
        let mut of_part = |part, rows: &[PlanRow], source| -> Result<Dataset, TruthError> {
            let errors = self.errors(part, rows, &mut noise);
            let mut data = read(&self.campaign, rows, plan.measurand, source, &errors)?;
            // The same stream for both parts: they come from the same hands.
            self.laboratory.fault.write(&mut data, &mut self.stream(Stage::Writing, 0));
            Ok(data)
        };
        let mut measurements = of_part(0, &plan.training, "measurements.csv")?;
        let holdout = of_part(1, &plan.holdout, "holdout.csv")?;
        let sigma = self.campaign.noise.sigma();
        self.laboratory.fault.slip(&mut measurements, &sigma, &mut self.stream(Stage::Slips, 0));
        Ok([measurements, holdout])
    }

    fn errors(&self, part: u64, rows: &[PlanRow], noise: &mut Pcg64) -> Vec<Vector6> {
        let mut errors: Vec<Vector6> = rows.iter().map(|_| self.campaign.noise.draw(noise)).collect();
        let mut rng = self.stream(Stage::Errors, part);
        self.laboratory.fault.err(rows, &self.campaign.noise.sigma(), &mut errors, &mut rng);
        errors
    }

    fn stream(&self, stage: Stage, part: u64) -> Pcg64 {
        stage.stream(self.seed, part)
    }
}
