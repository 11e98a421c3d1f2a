//! From load to reading: the first-order chain of the model and its exact derivatives.
//!
//! At one condition, with spring compliances `c`, leg force change `phi = f - f0 + sum p F`, extra elongations
//! `sum p E`, Cartesian stiffness `K = sum p K_k` beside the legs, extra motions `sum p X` and target terms
//! `D = sum p D_k`:
//!
//! ```text
//! g  = c * phi + sum p E                      leg elongations
//! S  = J diag(c) J'                           compliance of the legs, J the platform Jacobian
//! dx = (I + S K)^-1 J g + sum p X             motion of the platform
//! y  = H (I + D) dx                           reading, H the observer
//! ```
//!
//! Every parameter enters through one [`Action`]; the chain is linear in each parameter taken
//! alone, except a stiffness beside the legs, which enters through the inverse.

use hexbench_core::{Matrix6, Vector6};

use crate::estimation::campaign::Condition;

/// Where one unit of a parameter acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// `F`: extra leg force change seen by the leg springs, N per unit.
    Force(Vector6),
    /// `E`: extra leg elongation, m per unit.
    Elongation(Vector6),
    /// `K`: Cartesian stiffness beside the legs, at the mobile origin, fixed axes, per unit.
    Stiffness(Matrix6),
    /// `X`: extra geometric twist of the platform at the mobile origin, per unit.
    Twist(Vector6),
    /// `E` and `F` at once: a joint that is elsewhere changes a length and, with the directions, all leg forces.
    Joint {
        /// As of [`Action::Elongation`].
        elongation: Vector6,
        /// As of [`Action::Force`].
        force: Vector6,
    },
    /// `X` and `F` at once: a frame that is elsewhere moves the reading and turns the legs under the load.
    Frame {
        /// As of [`Action::Twist`].
        twist: Vector6,
        /// As of [`Action::Force`].
        force: Vector6,
    },
    /// `D`: twist of the target from the twist of the platform, per unit.
    Target(Matrix6),
}

impl Action {
    /// The same action confined to one leg; `None` when it does not act leg by leg.
    pub fn of_leg(&self, leg: usize) -> Option<Self> {
        let only = |v: &Vector6| {
            let mut w = Vector6::zeros();
            w[leg] = v[leg];
            w
        };
        match self {
            Self::Force(f) => Some(Self::Force(only(f))),
            Self::Elongation(e) => Some(Self::Elongation(only(e))),
            _ => None,
        }
    }
}

/// Sum of the actions of all active parameters at one condition.
#[derive(Debug, Clone, Copy, Default)]
pub struct Load {
    force: Vector6,
    elongation: Vector6,
    twist: Vector6,
    stiffness: Option<Matrix6>,
    target: Option<Matrix6>,
}

impl Load {
    /// Add `p` units of an action.
    pub fn add(&mut self, action: &Action, p: f64) {
        match action {
            Action::Force(f) => self.force += p * f,
            Action::Elongation(e) => self.elongation += p * e,
            Action::Twist(x) => self.twist += p * x,
            Action::Joint { elongation, force } => {
                self.elongation += p * elongation;
                self.force += p * force;
            }
            Action::Frame { twist, force } => {
                self.twist += p * twist;
                self.force += p * force;
            }
            Action::Stiffness(k) => *self.stiffness.get_or_insert_with(Matrix6::zeros) += p * k,
            Action::Target(d) => *self.target.get_or_insert_with(Matrix6::zeros) += p * d,
        }
    }
}

/// The chain at one condition and one set of parameter values: prediction and derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// `phi`, N.
    force: Vector6,
    /// Motion of the platform before extra motions, geometric twist.
    elastic: Vector6,
    /// Motion of the platform, geometric twist.
    motion: Vector6,
    /// Whitened observer with target terms: `W H (I + D)`.
    reader: Matrix6,
    /// Whitened observer `W H`.
    bare_reader: Matrix6,
    /// `(I + S K)^-1 J`.
    legs_to_motion: Matrix6,
    springs: Vector6,
    /// Leg force per leg carried by the parallel stiffness: `J' K dx`.
    relief: Vector6,
}

impl Link {
    /// The chain of a condition under compliances `springs` (m/N) and the summed actions `load`.
    pub fn at(condition: &Condition, springs: &Vector6, load: &Load) -> Self {
        let j = condition.legs.platform_jacobian;
        let force = condition.force - condition.reference_force + load.force;
        let elongation = springs.component_mul(&force) + load.elongation;
        let mut bare_reader = condition.observer;
        for k in 0..6 {
            bare_reader.row_mut(k).scale_mut(condition.weight[k]);
        }
        let reader = load.target.map_or(bare_reader, |d| bare_reader * (Matrix6::identity() + d));
        let (legs_to_motion, elastic, relief) = match load.stiffness {
            None => (j, j * elongation, Vector6::zeros()),
            Some(k) => {
                let compliance = j * Matrix6::from_diagonal(springs) * j.transpose();
                let a =
                    (Matrix6::identity() + compliance * k).try_inverse().unwrap_or_else(Matrix6::identity);
                let elastic = a * (j * elongation);
                (a * j, elastic, j.tr_mul(&(k * elastic)))
            }
        };
        let motion = elastic + load.twist;
        Self { force, elastic, motion, reader, bare_reader, legs_to_motion, springs: *springs, relief }
    }

    /// Motion of the platform, geometric twist at the mobile origin.
    pub fn motion(&self) -> Vector6 {
        self.motion
    }

    /// Predicted reading, whitened.
    pub fn prediction(&self) -> Vector6 {
        self.reader * self.motion
    }

    /// Whitened reading per elongation of each leg (6x6).
    pub fn by_elongation(&self) -> Matrix6 {
        self.reader * self.legs_to_motion
    }

    /// Derivative of the whitened reading by the compliance of one leg.
    pub fn by_spring(&self, leg: usize) -> Vector6 {
        self.reader * (self.legs_to_motion.column(leg) * (self.force[leg] - self.relief[leg]))
    }

    /// Derivative of the whitened reading by a parameter with this action.
    pub fn by_action(&self, condition: &Condition, action: &Action) -> Vector6 {
        match action {
            Action::Force(f) => self.reader * (self.legs_to_motion * self.springs.component_mul(f)),
            Action::Elongation(e) => self.reader * (self.legs_to_motion * e),
            Action::Twist(x) => self.reader * x,
            Action::Joint { elongation, force } => {
                self.reader * (self.legs_to_motion * (elongation + self.springs.component_mul(force)))
            }
            Action::Frame { twist, force } => {
                self.reader * (twist + self.legs_to_motion * self.springs.component_mul(force))
            }
            Action::Target(d) => self.bare_reader * (d * self.motion),
            Action::Stiffness(k) => {
                let leg_load = condition.legs.platform_jacobian.tr_mul(&(k * self.elastic));
                -(self.reader * (self.legs_to_motion * self.springs.component_mul(&leg_load)))
            }
        }
    }
}
