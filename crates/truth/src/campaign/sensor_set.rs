//! The same campaign read with something else than a full pose.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Channel, Hexapod, Observation, Sensor, SensorKind, UNREAD, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{PlanRow, SimulatedCase};
use crate::TruthError;
use crate::metrology::read_sensors;

/// Standard deviation of a gauge, m.
const GAUGE: f64 = 0.2e-6;
/// Of each coordinate of a ball, m.
const BALL: f64 = 0.6e-6;
/// Of a level, rad.
const LEVEL: f64 = 1.5e-6;
/// Share of the cells that stay empty.
const EMPTY: f64 = 0.2;
/// A wrong factor: inches.
const INCH: f64 = 25.4;
/// A sensor beside its place, m.
const BESIDE: f64 = 0.01;

/// What a laboratory reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum SensorSet {
    /// Six pose numbers.
    Poses,
    /// Six pose numbers, a fifth of the cells empty.
    PosesWithGaps,
    /// Three balls on the platform.
    ThreeBalls,
    /// Six gauges around the platform.
    SixGauges,
    /// Three gauges.
    ThreeGauges,
    /// One ball and two gauges.
    BallAndGauges,
    /// Three translations and two levels.
    TranslationsAndLevels,
    /// Three translations.
    Translations,
    /// A scale beside each leg.
    Scales,
}

impl SensorSet {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Poses,
        Self::PosesWithGaps,
        Self::ThreeBalls,
        Self::SixGauges,
        Self::ThreeGauges,
        Self::BallAndGauges,
        Self::TranslationsAndLevels,
        Self::Translations,
        Self::Scales,
    ];

    /// One word for names of trials.
    pub fn word(self) -> &'static str {
        match self {
            Self::Poses => "poses",
            Self::PosesWithGaps => "poses-with-gaps",
            Self::ThreeBalls => "three-balls",
            Self::SixGauges => "six-gauges",
            Self::ThreeGauges => "three-gauges",
            Self::BallAndGauges => "ball-and-gauges",
            Self::TranslationsAndLevels => "translations-and-levels",
            Self::Translations => "translations",
            Self::Scales => "scales",
        }
    }

    /// How many of the six pose numbers are read.
    fn pose_numbers(self) -> usize {
        match self {
            Self::Poses | Self::PosesWithGaps => 6,
            Self::TranslationsAndLevels | Self::Translations => 3,
            _ => 0,
        }
    }

    /// The sensors, on a ring beyond the joints and above them.
    fn sensors(self, hexapod: &Hexapod) -> Vec<Sensor> {
        let radius = 1.2 * hexapod.platform_radius();
        let at = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            Vector3::new(radius * c, radius * s, 0.3 * radius)
        };
        let along = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            Vector3::new(-s, c, 0.0)
        };
        let gauge = |name: &str, degrees: f64, direction: Vector3| {
            Sensor::new(name, SensorKind::Distance { point: at(degrees), direction, sigma: GAUGE })
        };
        let ball = |name: &str, degrees: f64| {
            Sensor::new(name, SensorKind::Point { point: at(degrees), sigma: [BALL; 3] })
        };
        let level =
            |name: &str, axis: Vector3| Sensor::new(name, SensorKind::Inclination { axis, sigma: LEVEL });
        let up = Vector3::z();
        match self {
            Self::Poses | Self::PosesWithGaps | Self::Translations => Vec::new(),
            Self::ThreeBalls => vec![ball("ball1", 20.0), ball("ball2", 140.0), ball("ball3", 260.0)],
            Self::SixGauges => vec![
                gauge("z1", 0.0, up),
                gauge("z2", 120.0, up),
                gauge("z3", 240.0, up),
                gauge("t1", 60.0, along(60.0)),
                gauge("t2", 180.0, along(180.0)),
                gauge("t3", 300.0, along(300.0)),
            ],
            Self::ThreeGauges => vec![
                gauge("z1", 15.0, up),
                gauge("t1", 130.0, along(130.0)),
                gauge("t2", 250.0, (along(250.0) + up).normalize()),
            ],
            Self::BallAndGauges => {
                vec![ball("ball", 25.0), gauge("g1", 145.0, up), gauge("g2", 265.0, up)]
            }
            Self::TranslationsAndLevels => {
                vec![level("level_x", Vector3::x()), level("level_y", Vector3::y())]
            }
            Self::Scales => (0..6)
                .map(|leg| {
                    Sensor::new(format!("scale{}", leg + 1), SensorKind::LegLength { leg, sigma: GAUGE })
                })
                .collect(),
        }
    }
}

/// What is wrong with the first sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorFault {
    /// It reads with the other sign.
    Sign,
    /// Its numbers are inches.
    Factor,
    /// It stands 10 mm beside its place.
    Place,
}

impl SensorFault {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sign, Self::Factor, Self::Place];

    /// The kind of finding that calls it by its name.
    pub fn word(self) -> &'static str {
        match self {
            Self::Sign => "sensor-sign",
            Self::Factor => "sensor-factor",
            Self::Place => "sensor-place",
        }
    }
}

impl SimulatedCase {
    /// The same machine, effects, poses and loads, read in another way; its noise is drawn anew.
    ///
    /// # Errors
    /// As [`World::before_and_after`](crate::World::before_and_after).
    pub fn read_with(&mut self, set: SensorSet, fault: Option<SensorFault>) -> Result<(), TruthError> {
        let mut rng = stream(self.spec.seed, Purpose::CaseSensors, [set as u64]);
        self.hexapod.sensors = set.sensors(&self.hexapod);
        for part in [&mut self.measurements, &mut self.holdout] {
            let read = Reading { set, fault, hexapod: &self.hexapod, noise: &self.spec.noise.sigma().into() };
            let mut observations = Vec::new();
            for row in &part.observations {
                let situation = PlanRow::from(row).situation;
                let states = self.campaign.world.before_and_after(&situation)?;
                let pose = self.campaign.world.deflection(&situation)?;
                observations.extend(read.row(
                    row,
                    &pose.into(),
                    &read_sensors(&self.hexapod, &states),
                    &mut rng,
                ));
            }
            part.observations = observations;
            part.blocks = Channel::in_blocks(&read.channels());
            part.columns.sigma = part.has_other_readings();
        }
        if fault == Some(SensorFault::Place) {
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

/// How rows are read.
struct Reading<'a> {
    set: SensorSet,
    fault: Option<SensorFault>,
    hexapod: &'a Hexapod,
    noise: &'a [f64; 6],
}

impl Reading<'_> {
    fn channels(&self) -> Vec<Channel> {
        Channel::all(0..self.set.pose_numbers(), &self.hexapod.sensors)
    }

    fn row(&self, row: &Observation, pose: &[f64; 6], sensors: &[f64], rng: &mut Pcg64) -> Vec<Observation> {
        let read: Vec<(f64, f64)> = self
            .channels()
            .into_iter()
            .enumerate()
            .map(|(n, channel)| self.number(channel, n, pose, sensors, rng))
            .collect();
        let observation = |(block, numbers): (usize, &[(f64, f64)])| {
            let (mut measured, mut sigmas) = ([0.0; 6], [UNREAD; 6]);
            for (k, &(value, sigma)) in numbers.iter().enumerate() {
                (measured[k], sigmas[k]) = (value, sigma);
            }
            let is_stated = self.set != SensorSet::Poses;
            Observation { block, measured, sigma: is_stated.then_some(sigmas), ..*row }
        };
        read.chunks(6).enumerate().map(observation).filter(|o| o.numbers() > 0).collect()
    }

    /// What a channel reads, and its standard deviation; the `n`-th of a row.
    fn number(
        &self,
        channel: Channel,
        n: usize,
        pose: &[f64; 6],
        sensors: &[f64],
        rng: &mut Pcg64,
    ) -> (f64, f64) {
        let (error, luck): (f64, f64) = (StandardNormal.sample(rng), rng.random());
        match channel {
            Channel::Pose(_) if self.set == SensorSet::PosesWithGaps && luck < EMPTY => (0.0, UNREAD),
            Channel::Pose(k) => (pose[k] + self.noise[k] * error, self.noise[k]),
            Channel::Sensor { sensor, number } => {
                let factor = match self.fault.filter(|_| sensor == 0) {
                    Some(SensorFault::Sign) => -1.0,
                    Some(SensorFault::Factor) => INCH.recip(),
                    _ => 1.0,
                };
                let sigma = self.hexapod.sensors[sensor].kind.sigma(number);
                (factor * (sensors[n - self.set.pose_numbers()] + sigma * error), sigma)
            }
            Channel::Nothing => (0.0, UNREAD),
        }
    }
}
