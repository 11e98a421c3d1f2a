//! The simulated experiment: the paper-like machine, its loads, and a coordinate measuring machine that reads balls.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Columns, Dataset, Hexapod, Measurand, Observation, Pose, Vector6, Wrench};
use hexbench_truth::campaign::{PlanKind, PlanRow, machines::RING_A};
use hexbench_truth::metrology::Balls;
use hexbench_truth::{Mechanism, Situation, TruthError, World};
use rand_pcg::Pcg64;

use super::published::{
    BEST_POSES, EFFECTIVE_KG, FULL_LOAD_KG, PRELOAD_KG, REPEATS, STIFFNESS_N_PER_UM, VALIDATION_MM,
};

/// Standard gravity, m/s^2.
const GRAVITY: f64 = 9.81;
/// Radius of the circle of the three balls, m.
const BALL_RADIUS: f64 = 0.12;
/// Standard deviation of one coordinate of a ball, m.
const BALL_SIGMA: f64 = 1e-6;

/// How well the noise of a pose follows from that of the balls, which is known here, relative.
const NOISE_TOLERANCE: f64 = 0.01;
/// Load that the deflection is read under, N, downwards.
pub fn effective_load() -> f64 {
    EFFECTIVE_KG * GRAVITY
}

/// Machine, true springs and instrument.
#[derive(Debug, Clone)]
pub struct PaperMachine {
    /// The machine as drawn.
    pub hexapod: Hexapod,
    balls: Balls,
    pub(super) seed: u64,
}

/// Which covariates a file carries beside poses and loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Covariates {
    /// None, as in the paper.
    None,
    /// Approach, temperature and time.
    All,
}

impl PaperMachine {
    /// The paper-like machine; noise is drawn from `seed`.
    pub fn new(seed: u64) -> Self {
        let mut hexapod = RING_A.hexapod("paper-like");
        hexapod.tolerances.noise = NOISE_TOLERANCE;
        Self { hexapod, balls: Balls::triangle(BALL_RADIUS, BALL_SIGMA), seed }
    }

    /// The world with the stiffnesses of Table 2 and further effects.
    pub fn world(&self, effects: Vec<Box<dyn Mechanism>>) -> World {
        let bare = World::new(self.hexapod.clone(), &STIFFNESS_N_PER_UM.map(|k| k * 1e6));
        effects.into_iter().fold(bare, World::with)
    }

    /// Deflections as the instrument gives them; equal numbers give equal noise whatever the world.
    pub(crate) fn measure(
        &self,
        world: &World,
        rows: &[PlanRow],
        covariates: Covariates,
        source: &str,
        number: u64,
    ) -> Result<Dataset, TruthError> {
        let mut rng = stream(self.seed, Purpose::PaperNoise, [number]);
        let read = |(i, row): (usize, &PlanRow)| {
            let ideal = world.deflection(&row.situation)?;
            let measured = self.read_balls(&row.situation.pose, &ideal, &mut rng)?;
            Ok(row.read(i as u64 + 2, measured.into(), Some(sigma())))
        };
        let observations = rows.iter().enumerate().map(read).collect::<Result<_, TruthError>>()?;
        Ok(dataset(source, covariates, observations))
    }

    /// The balls are probed in the reference state and under the load; each time the pose follows by superposition.
    fn read_balls(&self, pose: &Pose, deflection: &Vector6, rng: &mut Pcg64) -> Result<Vector6, TruthError> {
        let loaded = Pose::from_array((pose.to_vector() + deflection).into());
        let mut read = |pose: &Pose| {
            let seen = self.balls.measure(pose, rng);
            self.balls.register(&seen).map(|r| r.pose.to_vector())
        };
        let reference = read(pose)?;
        Ok(read(&loaded)? - reference)
    }
}

/// Deflections without noise.
pub(crate) fn ideal(world: &World, rows: &[PlanRow]) -> Result<Dataset, TruthError> {
    let read = |(i, row): (usize, &PlanRow)| {
        Ok(row.read(i as u64 + 2, world.deflection(&row.situation)?.into(), Some(sigma())))
    };
    let observations = rows.iter().enumerate().map(read).collect::<Result<_, TruthError>>()?;
    Ok(dataset("ideal", Covariates::None, observations))
}

/// Standard deviation of one deflection reading: difference of two superpositions of three balls on a circle.
pub fn sigma() -> [f64; 6] {
    let translation = BALL_SIGMA * (2.0_f64 / 3.0).sqrt();
    let tilt = BALL_SIGMA * 2.0_f64.sqrt() / (BALL_RADIUS * 1.5_f64.sqrt());
    let turn = BALL_SIGMA * 2.0_f64.sqrt() / (BALL_RADIUS * 3.0_f64.sqrt());
    [translation, translation, translation, tilt, tilt, turn]
}

/// A reading of nothing, for what depends on pose and load alone.
pub fn unread(situation: Situation) -> Observation {
    PlanRow::alone(1, 1, situation).read(2, [0.0; 6], Some(sigma()))
}

fn dataset(source: &str, covariates: Covariates, observations: Vec<Observation>) -> Dataset {
    let known = covariates == Covariates::All;
    let columns = Columns {
        reference: true,
        approach: known,
        delta_t: known,
        elapsed: known,
        sigma: true,
        ..Columns::default()
    };
    Dataset::of_poses(source, Measurand::DeflectionEuler, columns, observations)
}

/// A pose without tilt: a, b, c in mm, gamma in deg.
pub fn level_pose([a, b, c, gamma]: [f64; 4]) -> Pose {
    Pose::from_array([a * 1e-3, b * 1e-3, c * 1e-3, 0.0, 0.0, gamma.to_radians()])
}

/// A pose under the paper's load: read at the preload, then at the full load, both downwards.
pub fn loaded_pose(pose: Pose) -> Situation {
    let down = |kg: f64| Wrench::from_array([0.0, 0.0, -kg * GRAVITY, 0.0, 0.0, 0.0]);
    Situation { reference: down(PRELOAD_KG), ..Situation::new(pose, down(FULL_LOAD_KG)) }
}

/// Poses under the paper's load, each read so many times.
pub fn rows(poses: &[Pose], repeats: i64) -> Vec<PlanRow> {
    let numbered = (1..).zip(poses);
    let repeated = numbered.flat_map(|(pose_id, pose)| (1..=repeats).map(move |r| (pose_id, r, *pose)));
    repeated.map(|(pose_id, repeat, pose)| PlanRow::alone(pose_id, repeat, loaded_pose(pose))).collect()
}

/// Table 1: three poses, three readings each.
pub fn identification() -> Vec<PlanRow> {
    rows(&BEST_POSES.map(level_pose), REPEATS)
}

/// Table 3: five poses along X, then five along Y.
pub fn validation() -> Vec<PlanRow> {
    let along_x = VALIDATION_MM.map(|x| level_pose([x, 0.0, 0.0, 0.0]));
    let along_y = VALIDATION_MM.map(|y| level_pose([0.0, y, 0.0, 0.0]));
    rows(&[along_x, along_y].concat(), 1)
}

/// The bench's rich plan (18 poses with tilts, six loads along and about the axes, two readings each) turned as far about Z as
/// the paper turned its machine, and its held-out part.
///
/// Turning is what tells a base that yields, in fixed axes, from a plate that yields, in the platform's.
pub fn richer_plan(bench: &PaperMachine) -> [Vec<PlanRow>; 2] {
    const TURN: f64 = 2.0;
    let mut rng = stream(bench.seed, Purpose::PaperPlan, []);
    let plan = PlanKind::Rich.draw(&bench.hexapod, &mut rng);
    let turned = |row: PlanRow| {
        let mut situation = row.situation;
        situation.pose.angles.z *= TURN;
        PlanRow { situation, ..row }
    };
    [plan.training, plan.holdout].map(|rows| rows.into_iter().map(turned).collect())
}
