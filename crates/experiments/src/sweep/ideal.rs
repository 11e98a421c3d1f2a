//! What an ideal instrument reads: full poses, or the numbers of the sensors of the machine.

use hexbench_core::{Dataset, Measurand, Sensor, UNREAD, Vector6};
use hexbench_truth::campaign::{InputErrors, PlanRow, SimulatedCampaign};
use hexbench_truth::laboratory::FaultEntry;
use hexbench_truth::metrology::InstrumentNoise;
use hexbench_truth::{TruthError, World};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Rows and what an ideal instrument reads in them.
pub struct Ideal {
    rows: Vec<PlanRow>,
    readings: Readings,
}

enum Readings {
    /// Deflections, and their noise.
    Poses(Vec<Vector6>, InstrumentNoise),
    /// Numbers of these sensors, row by row.
    Sensed(Vec<Vec<f64>>, Vec<Sensor>),
}

impl Ideal {
    /// By the sensors of the machine, or in full poses where it has none.
    ///
    /// # Errors
    /// As [`SimulatedCampaign::sensed`].
    pub fn of(
        campaign: &SimulatedCampaign,
        errors: Option<&InputErrors>,
        rows: Vec<PlanRow>,
    ) -> Result<Self, TruthError> {
        let sensors = &campaign.world.hexapod.sensors;
        if sensors.is_empty() {
            return Self::in_poses(campaign, errors, rows);
        }
        let readings = Readings::Sensed(campaign.sensed(&rows)?, sensors.clone());
        Ok(Self { rows, readings })
    }

    /// In full poses, whatever sensors the machine has; with errors of the inputs where there are some.
    ///
    /// # Errors
    /// As [`SimulatedCampaign::ideal`].
    pub fn in_poses(
        campaign: &SimulatedCampaign,
        errors: Option<&InputErrors>,
        rows: Vec<PlanRow>,
    ) -> Result<Self, TruthError> {
        let read = match errors {
            None => campaign.ideal(&rows, Measurand::DeflectionEuler)?,
            Some(errors) => errors.ideal(copy(campaign), &rows, Measurand::DeflectionEuler)?,
        };
        Ok(Self { rows, readings: Readings::Poses(read, campaign.noise) })
    }

    /// The readings as a file would hold them, with noise of a generator or without.
    pub fn dataset(&self, source: &str, noise: Option<&mut Pcg64>) -> Dataset {
        match &self.readings {
            Readings::Poses(read, instrument) => {
                let mut noise = noise;
                let mut error =
                    || noise.as_deref_mut().map_or_else(Vector6::zeros, |rng| instrument.draw(rng));
                let errors: Vec<Vector6> = read.iter().map(|_| error()).collect();
                self.in_deflections(source, read, &errors)
            }
            Readings::Sensed(read, sensors) => self.in_numbers(source, read, sensors, noise),
        }
    }

    /// The readings with noise, its errors as a laboratory makes them; numbers of sensors have their noise alone.
    pub fn dataset_of(
        &self,
        source: &str,
        noise: &mut Pcg64,
        laboratory: &FaultEntry,
        faults: &mut Pcg64,
    ) -> Dataset {
        let Readings::Poses(read, instrument) = &self.readings else {
            return self.dataset(source, Some(noise));
        };
        let mut errors: Vec<Vector6> = read.iter().map(|_| instrument.draw(noise)).collect();
        laboratory.fault.err(&self.rows, &instrument.sigma(), &mut errors, faults);
        self.in_deflections(source, read, &errors)
    }

    fn in_deflections(&self, source: &str, ideal: &[Vector6], errors: &[Vector6]) -> Dataset {
        let read = |(line, ((row, ideal), error)): (u64, ((&PlanRow, &Vector6), &Vector6))| {
            row.read(line, (ideal + error).into(), None)
        };
        let rows = (2..).zip(self.rows.iter().zip(ideal).zip(errors)).map(read);
        Dataset::of_deflections(source, rows.collect())
    }

    fn in_numbers(
        &self,
        source: &str,
        ideal: &[Vec<f64>],
        sensors: &[Sensor],
        mut noise: Option<&mut Pcg64>,
    ) -> Dataset {
        let unread = (2..).zip(&self.rows).map(|(line, row)| row.read(line, [0.0; 6], None)).collect();
        let mut data = Dataset::of_deflections(source, unread).to_be_read_by(sensors);
        let mut error = || noise.as_deref_mut().map_or(0.0, |rng| StandardNormal.sample(rng));
        let blocks = ideal.iter().flat_map(|row| row.chunks(6));
        for (observation, numbers) in data.observations.iter_mut().zip(blocks) {
            let sigma = observation.sigma.unwrap_or([UNREAD; 6]);
            for (k, number) in numbers.iter().enumerate() {
                observation.measured[k] = number + sigma[k] * error();
            }
        }
        data
    }
}

/// The same campaign once more.
fn copy(campaign: &SimulatedCampaign) -> SimulatedCampaign {
    let mechanisms = campaign.world.mechanisms.iter().map(|effect| effect.scaled(1.0)).collect();
    let world = World { mechanisms, ..campaign.world.without_effects() };
    SimulatedCampaign { world, frames: campaign.frames, noise: campaign.noise }
}
