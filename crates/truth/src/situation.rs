//! What is done to the machine, and the moment at which a state of it is wanted.

use hexbench_core::{Approach, Hexapod, Pose, Wrench};

/// One row of a plan: commands, loads and surroundings. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Situation {
    /// Commanded pose.
    pub pose: Pose,
    /// Wrench in the loaded state.
    pub wrench: Wrench,
    /// Wrench in the reference state.
    pub reference: Wrench,
    /// How the load is reached.
    pub approach: Approach,
    /// Factor by which an overloaded approach exceeds the change of load first.
    pub overload: f64,
    /// Structure temperature at the loaded reading minus at the reference reading, K.
    pub delta_t: f64,
    /// Time from the reference reading to the loaded reading, s.
    pub elapsed: f64,
    /// Time for which the reference wrench had rested on the machine at the reference reading, s; none when the plan leaves it open.
    pub reference_age: Option<f64>,
}

impl Situation {
    /// A pose under a load, without reference load, temperature change or waiting.
    pub fn new(pose: Pose, wrench: Wrench) -> Self {
        let (reference, approach) = (Wrench::default(), Approach::default());
        Self {
            pose,
            wrench,
            reference,
            approach,
            overload: Approach::OVERLOAD,
            delta_t: 0.0,
            elapsed: 0.0,
            reference_age: None,
        }
    }

    /// The wrench by which an overloaded approach exceeds the load.
    pub fn exceeded(&self) -> Wrench {
        self.reference.beyond(&self.wrench, self.overload)
    }
}

/// A state on the path of one row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Reference wrench, read.
    Reference,
    /// A load on the way to the load, exceeded or an earlier one; not read.
    Overload,
    /// Load, read.
    Loaded,
}

/// The moment at which the mechanisms act: the row, where on its path, and what is known of the nominal machine there.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Nominal machine.
    pub hexapod: &'a Hexapod,
    /// The row.
    pub situation: &'a Situation,
    /// Where on the path.
    pub phase: Phase,
    /// Nominal leg lengths at the commanded pose, m.
    pub nominal_lengths: [f64; 6],
    /// Nominal leg lengths at the zero pose, m.
    pub home_lengths: [f64; 6],
    /// Loads that stood on the machine before, the reference load among them; empty until they were solved.
    pub past: &'a [PastForces],
    /// When the present load was put on, s from the reference reading.
    pub put_on: f64,
}

/// What the leg springs carried under an earlier load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PastForces {
    /// Forces of the leg springs, N.
    pub forces: [f64; 6],
    /// When the load was put on, s from the reference reading; none where nobody says.
    pub put_on: Option<f64>,
    /// True for the reference load of the reading.
    pub is_reference: bool,
}

impl Instant<'_> {
    /// Seconds since the reference reading.
    pub fn elapsed(&self) -> f64 {
        if self.phase == Phase::Loaded { self.situation.elapsed } else { 0.0 }
    }

    /// Temperature above the reference reading, K.
    pub fn delta_t(&self) -> f64 {
        if self.phase == Phase::Loaded { self.situation.delta_t } else { 0.0 }
    }

    /// True once the load of the row is on (or exceeded).
    pub fn is_loaded(&self) -> bool {
        self.phase != Phase::Reference
    }
}
