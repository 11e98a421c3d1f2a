//! One condition of a campaign: the machine under its loads, with legs and forces.

use hexbench_core::{Approach, Matrix6, PastLoad, Vector3, Vector6, Wrench};

use crate::estimation::equilibrium::Tangent;
use crate::estimation::reading_weights::ReadingWeights;
use crate::machine::kinematics::Legs;
use crate::machine::placement::Placement;

/// Least share of the best seen motion of the legs that the worst seen one has where all of them are told: beyond it, rounding takes the
/// digits that people read.
const TOLD: f64 = 1e-9;

/// One group with the legs and forces of its pose. Fixed frame, SI.
#[derive(Debug, Clone)]
pub struct Condition {
    /// Line of the file that holds its first reading.
    pub line: u64,
    /// Pose at which the legs stand: commanded (deflections) or measured, brought back to the platform (absolute).
    pub place: Placement,
    /// Legs of the calibrated machine at that pose.
    pub legs: Legs,
    /// Lengths the controller commanded, m.
    pub commanded_lengths: Vector6,
    /// Commanded lengths minus those of the zero pose, m.
    pub extension: Vector6,
    /// Wrench in the loaded state.
    pub wrench: Wrench,
    /// Wrench in the reference state.
    pub reference: Wrench,
    /// What acts in the reference state and under the load, and where.
    pub states: [LoadState; 2],
    /// Forces in the legs under the load, N, tension positive: what nothing beside the legs holds.
    pub force: Vector6,
    /// Forces in the legs in the reference state, N.
    pub reference_force: Vector6,
    /// Forces in the leg springs in the two states, N: the leg forces, less what friction holds.
    pub spring_forces: [Vector6; 2],
    /// Leg forces along the way from the reference to the reading.
    pub path: LoadPath,
    /// Loads that came before, those before the reference state first; empty where the file states no sequence.
    pub past: Vec<PastState>,
    /// When the load was put on, s from the reference reading.
    pub put_on: f64,
    /// Factor by which an overloaded approach exceeded the change of load first.
    pub overload: f64,
    /// Motion of the legs' platform against their base in the reference state, geometric twist.
    pub sag: Vector6,
    /// Change of leg force between reference and load that stands beside the legs and that the forces here are without, N.
    pub relief: Vector6,
    /// How the structure yields about these forces; none: by its springs alone.
    pub tangent: Option<Box<Tangent>>,
    /// How the load was reached.
    pub approach: Approach,
    /// Temperature difference, K.
    pub delta_t: f64,
    /// Time since the reference reading, s.
    pub elapsed: f64,
    /// Time the reference load had rested when the reference was read, s; none when the file does not say.
    pub reference_age: Option<f64>,
    /// Measured values minus what an unloaded perfect machine would show, in measured coordinates.
    pub reading: Vector6,
    /// Measured coordinates from the platform's geometric twist at the mobile origin (6x6).
    pub observer: Matrix6,
    /// What the averaged numbers are weighted by.
    pub weights: ReadingWeights,
    /// How many of the six numbers were read.
    pub numbers: usize,
    /// True when they are those of a pose.
    pub reads_pose: bool,
    /// Compliances of the leg springs where the model is linearized, m/N.
    pub compliances: Vector6,
}

/// What acts on the platform in one state. Fixed frame, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadState {
    /// Where the platform is, to second order in the deflection.
    pub place: Placement,
    /// The wrench `[F; M]` that acts at its origin, fixed axes: offsets and tilts of the load included.
    pub wrench: Vector6,
    /// Unit vectors along the legs, from base joint to platform joint.
    pub directions: [Vector3; 6],
    /// Lengths of the legs, m.
    pub lengths: Vector6,
}

/// An earlier load of the sequence that ends in the reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PastState {
    /// The load.
    pub load: PastLoad,
    /// Forces in the legs minus those in the reference state, N.
    pub change: Vector6,
    /// Forces in the leg springs, N.
    pub spring_forces: Vector6,
}

/// Leg forces (N, tension positive) along the way from the reference state to the reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadPath {
    /// In the reference state.
    pub reference: Vector6,
    /// At the largest load on the way: the load itself, or the overshoot.
    pub extreme: Vector6,
    /// Under the load.
    pub load: Vector6,
}

/// Spring force of one leg in the reference state and under the load of a path when a slider beside the spring holds up to `limit`
/// against the last motion; `passed` takes the one under each earlier load.
fn along(
    path: &LoadPath,
    past: &[PastState],
    leg: usize,
    limit: f64,
    mut passed: impl FnMut(f64),
) -> [f64; 2] {
    let play = |spring: f64, force: f64| spring.max(force - limit).min(force + limit);
    let (before, since) = past.split_at(past.partition_point(|state| state.load.before_reference));
    let mut pass = |spring: f64, state: &PastState| {
        let spring = play(spring, path.reference[leg] + state.change[leg]);
        passed(spring);
        spring
    };
    let rest = play(before.iter().fold(0.0, &mut pass), path.reference[leg]);
    let last = since.iter().fold(rest, &mut pass);
    [rest, play(play(last, path.extreme[leg]), path.load[leg])]
}

impl Condition {
    /// True where the six numbers of a reading tell how the platform moved, and with it the elongation of every leg. A pose does; only at
    /// beta = +-90 deg it says nothing of two rotations.
    pub fn tells_motion(&self) -> bool {
        self.numbers == 6
            && (self.reads_pose || {
                let shares = self.seen().singular_values();
                shares.min() > TOLD * shares.max()
            })
    }

    /// A change of the six numbers as they are read. Sensors stand on a frame: it moves as a whole.
    pub fn as_read(&self, change: &Vector6) -> Vector6 {
        if self.reads_pose { *change } else { self.observer * change }
    }

    /// What an elongation of each leg does to the numbers read, in standard deviations.
    pub(crate) fn seen(&self) -> Matrix6 {
        self.weights.of(self.observer) * self.legs.platform_jacobian
    }

    /// Geometric twist of the platform at the mobile origin that reads like this; zero where a reading does not tell it.
    pub fn motion(&self, reading: &Vector6) -> Vector6 {
        if !self.tells_motion() {
            return Vector6::zeros();
        }
        self.observer.try_inverse().map_or_else(Vector6::zeros, |h| h * reading)
    }

    /// Sets the forces in the legs (N) in the reference state and under the load; the largest ones on the way as the load is exceeded.
    pub fn set_forces(&mut self, [reference, load]: [Vector6; 2], limits: &Vector6) {
        let extreme = match self.approach {
            Approach::Direct => load,
            Approach::Overloaded => reference + self.overload * (load - reference),
        };
        self.set_path(LoadPath { reference, extreme, load }, limits);
    }

    /// Sets the forces in the legs, and with them those in the springs, beside which friction holds up to `limits` (N).
    pub fn set_path(&mut self, path: LoadPath, limits: &Vector6) {
        (self.reference_force, self.force, self.path) = (path.reference, path.load, path);
        let mut of_leg = [[0.0; 2]; 6];
        for (leg, ends) in of_leg.iter_mut().enumerate() {
            let mut passed = Vec::with_capacity(self.past.len());
            *ends = along(&path, &self.past, leg, limits[leg].max(0.0), |spring| passed.push(spring));
            self.past.iter_mut().zip(passed).for_each(|(state, spring)| state.spring_forces[leg] = spring);
        }
        self.spring_forces = [0, 1].map(|state| Vector6::from_fn(|leg, _| of_leg[leg][state]));
    }

    /// Spring force of one leg in the reference state and under the load when a slider beside the spring holds up to
    /// `limit` against the last motion, on the whole way from the unloaded machine.
    pub fn spring_forces_under(&self, leg: usize, limit: f64) -> [f64; 2] {
        along(&self.path, &self.past, leg, limit, |_| ())
    }

    /// Change of the pull of a leg on its base joint between reference and load, fixed axes, N.
    pub fn pull_change(&self, leg: usize) -> Vector3 {
        let [reference, loaded] = &self.states;
        loaded.directions[leg] * self.force[leg] - reference.directions[leg] * self.reference_force[leg]
    }

    /// Elongations of the legs, m, per weighted number of six that determine them.
    pub(crate) fn legs_of_reading(&self) -> Matrix6 {
        // Only at beta = +-90 deg, where the reading says nothing of two rotations.
        let to_legs = self.observer.try_inverse().map_or_else(Matrix6::zeros, |h| self.legs.leg_jacobian * h);
        to_legs * self.weights.numbers(Matrix6::identity())
    }

    /// Change of the forces in the leg springs between reference and load, N.
    pub fn spring_change(&self) -> Vector6 {
        self.spring_forces[1] - self.spring_forces[0]
    }

    /// Change of leg force between reference and load, N.
    pub fn force_change(&self) -> Vector6 {
        self.force - self.reference_force
    }

    /// Change of all leg forces (N) under the same wrench when the platform end of one leg moves by `end` against its base
    /// end, and its arm from the mobile origin by `arm`. Fixed axes, m.
    pub fn force_response(&self, leg: usize, end: &Vector3, arm: &Vector3) -> Vector6 {
        -self.legs.forces(&self.wrench_of_turn(leg, end, arm))
    }

    /// Change of the wrench (N, N m) that the force in one leg has at the mobile origin, fixed axes, when it moves as of
    /// [`Self::force_response`].
    pub(crate) fn wrench_of_turn(&self, leg: usize, end: &Vector3, arm: &Vector3) -> Vector6 {
        let (n, length) = (self.legs.directions[leg], self.legs.lengths[leg]);
        let turn = (end - n * n.dot(end)) / length;
        let moment = arm.cross(&n) + self.legs.arms[leg].cross(&turn);
        self.force[leg] * Vector6::new(turn.x, turn.y, turn.z, moment.x, moment.y, moment.z)
    }
}
