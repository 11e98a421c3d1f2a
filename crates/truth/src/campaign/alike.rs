//! One campaign read in three ways that tell the same of the platform.
//!
//! Three balls at radius `r` in the plane of the mobile origin, read to `s` in each coordinate, tell of the motion `[v; w]` of an upright
//! platform
//!
//! ```text
//! H' H / s^2 = diag(3, 3, 3, 1.5 r^2, 1.5 r^2, 3 r^2) / s^2
//! ```
//!
//! So do their boiled-down pose, with the standard deviations that follow, and six gauges that read to `s sqrt(2/3)` in three pairs:
//! along z at `-+x r/sqrt(2)`, along y at `-+z r/sqrt(2)`, along x at `-+y r`. The errors of the balls are drawn; those of pose and gauges
//! are what follows from them, and are independent with just these standard deviations.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Channel, Hexapod, Observation, Sensor, SensorKind, Tolerances, UNREAD, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::sensor_readings::{EMPTY, in_blocks};
use super::sensor_set::{BALL, ring_radius};
use super::{PlanRow, SimulatedCase};
use crate::TruthError;
use crate::metrology::read_sensors;

/// Tolerance of what counts as exact: m, rad or relative.
const EXACT: f64 = 1e-9;
/// Tolerance of the noise, which is as stated: numbers to spare, such as three of nine of the balls, tell nothing more of it.
const EXACT_NOISE: f64 = 1e-3;

/// Ways of reading that tell the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AlikeReadings {
    /// Six pose numbers.
    Pose,
    /// Three points.
    Points,
    /// Six distances.
    Distances,
}

hexbench_core::worded! {
    /// A few words for tables.
    AlikeReadings::words {
        Pose => "a pose",
        Points => "three points",
        Distances => "six distances",
    }
}

impl AlikeReadings {
    fn sensors(self, radius: f64) -> Vec<Sensor> {
        match self {
            Self::Pose => Vec::new(),
            Self::Points => {
                let ball = |(k, point)| {
                    Sensor::new(format!("ball{}", k + 1), SensorKind::Point { point, sigma: [BALL; 3] })
                };
                balls(radius).into_iter().enumerate().map(ball).collect()
            }
            Self::Distances => {
                let near = radius * FRAC_1_SQRT_2;
                let pairs = [
                    ("z", Vector3::z(), Vector3::x() * near),
                    ("y", Vector3::y(), Vector3::z() * near),
                    ("x", Vector3::x(), Vector3::y() * radius),
                ];
                let sigma = BALL * SQRT_2 / 3.0_f64.sqrt();
                let gauge = |name, direction, (number, point)| {
                    Sensor::new(format!("{name}{number}"), SensorKind::Distance { point, direction, sigma })
                };
                pairs
                    .into_iter()
                    .flat_map(|(name, u, p)| [(1, p), (2, -p)].map(|placed| gauge(name, u, placed)))
                    .collect()
            }
        }
    }
}

/// Three balls about the mobile origin, mobile frame, m.
fn balls(radius: f64) -> [Vector3; 3] {
    [20.0_f64, 140.0, 260.0].map(|degrees| {
        let (s, c) = degrees.to_radians().sin_cos();
        Vector3::new(radius * c, radius * s, 0.0)
    })
}

impl SimulatedCase {
    /// The same machine, effects, loads and positions with an upright platform, read in one of the ways; with `gaps` a fifth of the
    /// cells stays empty. Inputs and noise are exact, and stated so.
    ///
    /// # Errors
    /// As [`World::before_and_after`](crate::World::before_and_after).
    pub fn read_alike(&mut self, way: AlikeReadings, gaps: bool) -> Result<(), TruthError> {
        let radius = ring_radius(&self.hexapod);
        self.hexapod.sensors = way.sensors(radius);
        self.hexapod.tolerances = exact();
        let mut rng = stream(self.spec.seed, Purpose::CaseAlikeNoise, []);
        let mut luck = stream(self.spec.seed, Purpose::CaseAlikeGaps, [way as u64]);
        for part in [&mut self.measurements, &mut self.holdout] {
            let mut observations = Vec::new();
            for row in &part.observations {
                let row = upright(row);
                let situation = PlanRow::from(&row).situation;
                let states = self.campaign.world.before_and_after(&situation)?;
                let pose = self.campaign.world.deflection(&situation)?;
                let ideal: Vec<f64> = match way {
                    AlikeReadings::Pose => pose.iter().copied().collect(),
                    _ => read_sensors(&self.hexapod, &states),
                };
                let errors = errors(way, &self.hexapod, radius, &mut rng);
                let mut numbers: Vec<(f64, f64)> =
                    ideal.iter().zip(errors).map(|(value, (error, sigma))| (value + error, sigma)).collect();
                for number in &mut numbers {
                    if luck.random::<f64>() < EMPTY && gaps {
                        *number = (0.0, UNREAD);
                    }
                }
                observations.extend(in_blocks(&row, &numbers, true));
            }
            let pose_numbers = if way == AlikeReadings::Pose { 6 } else { 0 };
            part.observations = observations;
            part.blocks = Channel::in_blocks(&Channel::all(0..pose_numbers, &self.hexapod.sensors));
            part.columns.sigma = true;
        }
        Ok(())
    }
}

fn exact() -> Tolerances {
    Tolerances { noise: EXACT_NOISE, ..Tolerances::every(EXACT) }
}

fn upright(row: &Observation) -> Observation {
    let mut row = *row;
    row.pose.angles = Vector3::zeros();
    row
}

/// Errors of the numbers of a row with their standard deviations: those of three balls, and what follows from them.
fn errors(way: AlikeReadings, hexapod: &Hexapod, radius: f64, rng: &mut Pcg64) -> Vec<(f64, f64)> {
    let of_balls: [Vector3; 3] = std::array::from_fn(|_| Vector3::from_fn(|_, _| BALL * normal(rng)));
    let lever = Vector3::new(1.5, 1.5, 3.0) * radius.powi(2);
    let shift = of_balls.iter().sum::<Vector3>() / 3.0;
    let turned: Vector3 = balls(radius).iter().zip(&of_balls).map(|(p, error)| p.cross(error)).sum();
    let turn = turned.component_div(&lever);
    match way {
        AlikeReadings::Points => {
            of_balls.iter().flat_map(|e| e.iter().map(|x| (*x, BALL)).collect::<Vec<_>>()).collect()
        }
        AlikeReadings::Pose => {
            let shifts = shift.iter().map(|x| (*x, BALL / 3.0_f64.sqrt()));
            shifts.chain(turn.iter().zip(&lever).map(|(x, lever)| (*x, BALL / lever.sqrt()))).collect()
        }
        AlikeReadings::Distances => {
            let error = |sensor: &Sensor| match &sensor.kind {
                SensorKind::Distance { point, direction, sigma } => {
                    (direction.dot(&(shift + turn.cross(point))), *sigma)
                }
                _ => (0.0, UNREAD),
            };
            hexapod.sensors.iter().map(error).collect()
        }
    }
}

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use hexbench_core::Matrix6;

    use super::*;
    use crate::campaign::CaseKind;

    /// Whitened rows of what a way reads of the motion `[v; w]` of an upright platform, times their transpose.
    fn information(way: AlikeReadings, radius: f64) -> Matrix6 {
        let mut all = Matrix6::zeros();
        for sensor in way.sensors(radius) {
            let rows: Vec<(Vector3, Vector3, f64)> = match sensor.kind {
                SensorKind::Distance { point, direction, sigma } => vec![(direction, point, sigma)],
                SensorKind::Point { point, sigma } => {
                    (0..3).map(|k| (Vector3::ith(k, 1.0), point, sigma[k])).collect()
                }
                _ => Vec::new(),
            };
            for (u, p, sigma) in rows {
                let turn = p.cross(&u);
                let row = hexbench_core::Vector6::new(u.x, u.y, u.z, turn.x, turn.y, turn.z) / sigma;
                all += row * row.transpose();
            }
        }
        all
    }

    #[test]
    fn three_points_and_six_distances_tell_the_same_of_a_motion() {
        let radius = 0.13;
        let [points, distances] =
            [AlikeReadings::Points, AlikeReadings::Distances].map(|way| information(way, radius));
        let apart = (points - distances).norm() / points.norm();
        assert!(apart < 1e-14, "{apart:e}");
        let case = SimulatedCase::draw(CaseKind::Clean, 0, 1, None).unwrap();
        let mut rng = stream(1, Purpose::CaseAlikeNoise, []);
        let pose = errors(AlikeReadings::Pose, &case.hexapod, radius, &mut rng);
        for (k, (_, sigma)) in pose.iter().enumerate() {
            assert!((points[(k, k)] * sigma * sigma - 1.0).abs() < 1e-12, "{k}: {sigma:e}");
        }
    }

    #[test]
    fn errors_of_gauges_that_follow_from_those_of_balls_are_as_large_as_stated_and_independent() {
        const DRAWN: usize = 20_000;
        let mut case = SimulatedCase::draw(CaseKind::Clean, 0, 1, None).unwrap();
        let radius = ring_radius(&case.hexapod);
        case.hexapod.sensors = AlikeReadings::Distances.sensors(radius);
        let mut rng = stream(2, Purpose::CaseAlikeNoise, []);
        let mut all = Matrix6::zeros();
        for _ in 0..DRAWN {
            let drawn = errors(AlikeReadings::Distances, &case.hexapod, radius, &mut rng);
            let z = hexbench_core::Vector6::from_fn(|k, _| drawn[k].0 / drawn[k].1);
            all += z * z.transpose() / DRAWN as f64;
        }
        let apart = (all - Matrix6::identity()).abs().max();
        assert!(apart < 0.05, "{all}");
    }
}
