//! The same campaign read with sensors that are set up to their tolerance.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Channel, Hexapod, Observation, SensorKind, Tolerances, UNREAD, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{PlanRow, SensorFault, SensorSet, SimulatedCase};
use crate::metrology::read_sensors;
use crate::{TruthError, so3};

/// Share of the cells that stay empty.
pub(super) const EMPTY: f64 = 0.2;
/// A wrong factor: inches.
const INCH: f64 = 25.4;
/// A sensor beside its place, m.
const BESIDE: f64 = 0.01;
/// A sensor that shows too much, relative.
const TOO_MUCH: f64 = 0.05;

/// How a campaign is read.
#[derive(Debug, Clone, Copy)]
pub struct SensorReadings {
    /// With what.
    pub set: SensorSet,
    /// What is wrong with the first sensor.
    pub fault: Option<SensorFault>,
    /// Whether the readings have errors of their own.
    pub is_noisy: bool,
}

impl SimulatedCase {
    /// The same machine, effects, poses and loads, read in another way: sensors stand where the file says to their tolerance, and noise is
    /// drawn anew. Both are the same for every fault.
    ///
    /// # Errors
    /// As [`World::before_and_after`](crate::World::before_and_after).
    pub fn read_with(&mut self, how: SensorReadings) -> Result<(), TruthError> {
        let mut rng = stream(self.spec.seed, Purpose::CaseSensors, [how.set as u64]);
        let mut of_setup = stream(self.spec.seed, Purpose::CaseSensorSetup, [how.set as u64]);
        self.hexapod.sensors = how.set.sensors(&self.hexapod);
        let real = set_up(&self.hexapod, &mut of_setup);
        for part in [&mut self.measurements, &mut self.holdout] {
            let read = Reading { how, real: &real, noise: &self.spec.noise.sigma().into() };
            let mut observations = Vec::new();
            for row in &part.observations {
                let situation = PlanRow::from(row).situation;
                let states = self.campaign.world.before_and_after(&situation)?;
                let pose = self.campaign.world.deflection(&situation)?;
                let numbers = read.row(&pose.into(), &read_sensors(&real, &states), &mut rng);
                observations.extend(in_blocks(row, &numbers, how.set != SensorSet::Poses));
            }
            part.observations = observations;
            part.blocks = Channel::in_blocks(&read.channels());
            part.columns.sigma = part.has_other_readings();
        }
        if how.fault == Some(SensorFault::Place) {
            let first = self.hexapod.sensors.first_mut();
            if let Some(SensorKind::Distance { point, .. } | SensorKind::Point { point, .. }) =
                first.map(|s| &mut s.kind)
            {
                point.x += BESIDE;
            }
        }
        Ok(())
    }
}

/// The machine with its sensors as they are, which is as the file says to its tolerance only.
fn set_up(hexapod: &Hexapod, rng: &mut Pcg64) -> Hexapod {
    let Tolerances { sensor_point, sensor_direction, sensor_gain, .. } = hexapod.tolerances;
    let mut real = hexapod.clone();
    let mut three = |sigma: f64| Vector3::from_fn(|_, _| normal(rng) * sigma);
    for sensor in &mut real.sensors {
        let (off, turn) = (three(sensor_point), so3::exp(&three(sensor_direction)));
        match &mut sensor.kind {
            SensorKind::Distance { point, direction, .. } => {
                *point += off;
                *direction = turn * *direction;
            }
            SensorKind::Point { point, .. } => *point += off,
            SensorKind::Inclination { axis, .. } => *axis = turn * *axis,
            SensorKind::LegLength { .. } | SensorKind::Function { .. } => {}
        }
    }
    for sensor in &mut real.sensors {
        sensor.gain = 1.0 + sensor_gain * normal(rng);
    }
    real
}

/// One row of numbers, each with its standard deviation, as observations of up to six; nothing where nothing was read.
pub(super) fn in_blocks(row: &Observation, numbers: &[(f64, f64)], is_stated: bool) -> Vec<Observation> {
    let observation = |(block, numbers): (usize, &[(f64, f64)])| {
        let (mut measured, mut sigmas) = ([0.0; 6], [UNREAD; 6]);
        for (k, &(value, sigma)) in numbers.iter().enumerate() {
            (measured[k], sigmas[k]) = (value, sigma);
        }
        Observation { block, measured, sigma: is_stated.then_some(sigmas), ..*row }
    };
    numbers.chunks(6).enumerate().map(observation).filter(|o| o.numbers() > 0).collect()
}

/// How rows are read.
struct Reading<'a> {
    how: SensorReadings,
    real: &'a Hexapod,
    noise: &'a [f64; 6],
}

impl Reading<'_> {
    fn channels(&self) -> Vec<Channel> {
        Channel::all(0..self.how.set.pose_numbers(), &self.real.sensors)
    }

    /// What all channels read, each with its standard deviation.
    fn row(&self, pose: &[f64; 6], sensors: &[f64], rng: &mut Pcg64) -> Vec<(f64, f64)> {
        let ideal: Vec<f64> = pose[..self.how.set.pose_numbers()].iter().chain(sensors).copied().collect();
        self.channels()
            .into_iter()
            .zip(ideal)
            .map(|(channel, value)| self.number(channel, value, rng))
            .collect()
    }

    fn number(&self, channel: Channel, ideal: f64, rng: &mut Pcg64) -> (f64, f64) {
        let (error, luck): (f64, f64) = (normal(rng), rng.random());
        let error = if self.how.is_noisy { error } else { 0.0 };
        match channel {
            Channel::Pose(_) if self.how.set == SensorSet::PosesWithGaps && luck < EMPTY => (0.0, UNREAD),
            Channel::Pose(k) => (ideal + self.noise[k] * error, self.noise[k]),
            Channel::Sensor { sensor, number } => {
                let factor = match self.how.fault.filter(|_| sensor == 0) {
                    Some(SensorFault::Sign) => -1.0,
                    Some(SensorFault::Factor) => INCH.recip(),
                    Some(SensorFault::Gain) => 1.0 + TOO_MUCH,
                    _ => 1.0,
                };
                let sigma = self.real.sensors[sensor].kind.sigma(number);
                (factor * (ideal + sigma * error), sigma)
            }
            Channel::Nothing => (0.0, UNREAD),
        }
    }
}

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}
