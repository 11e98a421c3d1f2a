//! From load to reading: the first-order chain of the model and its exact derivatives.
//!
//! At one condition, whose leg forces are those of the [equilibrium](crate::estimation::equilibrium) of all terms: with spring
//! compliances `c`, change of spring force `phi = (f - f0 of the springs) + sum p F`, extra elongations `sum p E`, Cartesian stiffness
//! `K = sum p K_k` beside the legs, extra motions `sum p X`, target terms `D = sum p D_k`, what the instrument adds `sum p Y`, and the
//! tangent compliance `C` (6x6) of *all* that yields in the legs:
//!
//! ```text
//! g  = c * phi + sum p E                      leg elongations
//! S  = J C J'                                 tangent compliance of the legs, J the platform Jacobian
//! dx = (I + S K)^-1 J (g + C r) + sum p X     motion of the platform; r: relief by K that the forces have already
//! y  = H (I + D) dx + sum p Y                 reading, H the observer
//! ```
//!
//! Every parameter enters through one [`Action`]. What a parameter changes, all others feel: more elongation by it takes load off
//! the legs wherever something stands beside them, and a leg yields to that by its tangent, not by its spring alone.

use hexbench_core::{Matrix6, Vector3, Vector6};

use crate::estimation::campaign::Condition;
use crate::estimation::equilibrium::{Tangent, against, compliance};
use crate::machine::bending;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::Legs;
use crate::machine::placement::Placement;

/// Where one unit of a parameter acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// `F`: extra force change in the leg springs alone, N per unit: they yield `c` times as much.
    Force(Vector6),
    /// Extra wrench `[F; M]` on the platform at the mobile origin under the load, fixed axes, per unit: everything yields to it.
    Wrench(Vector6),
    /// `E`: extra leg elongation, m per unit.
    Elongation(Vector6),
    /// Displacement of the base joints on what carries them, fixed axes, m per unit: the legs turn with it.
    Shift([Vector3; 6]),
    /// `K`: Cartesian stiffness beside the legs, at the mobile origin, fixed axes, per unit.
    Stiffness(Box<Matrix6>),
    /// Stiffness of all joints against turns of their leg, at the base end and at the platform end, N m/rad per unit.
    Bending([f64; 2]),
    /// Motion of the base with all legs on it: geometric twist at the mobile origin, per unit.
    Base(Vector6),
    /// `X`: motion of load and targets against the legs' platform: geometric twist at the mobile origin, per unit.
    Plate(Vector6),
    /// `E` and `F` at once: a joint that is elsewhere changes a length and, with the directions, all leg forces.
    Joint {
        /// As of [`Action::Elongation`].
        elongation: Vector6,
        /// Extra change of the leg forces, N per unit.
        force: Vector6,
    },
    /// A motion of the platform and `F` at once: a frame that is elsewhere moves the reading and turns the legs under the load.
    Frame {
        /// As of [`Action::Plate`].
        twist: Vector6,
        /// Extra change of the leg forces, N per unit.
        force: Vector6,
    },
    /// `D`: twist of the target from the twist of the platform, per unit.
    Target(Box<Matrix6>),
    /// `Y`: what the instrument adds to its reading, in measured coordinates, m and rad per unit.
    Reading(Vector6),
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
            Self::Shift(all) => {
                let mut one = [Vector3::zeros(); 6];
                one[leg] = all[leg];
                Some(Self::Shift(one))
            }
            _ => None,
        }
    }
}

/// Sum of the actions of all active parameters at one condition.
#[derive(Debug, Clone, Copy, Default)]
pub struct Load {
    force: Vector6,
    elongation: Vector6,
    shift: Option<[Vector3; 6]>,
    base: Vector6,
    plate: Vector6,
    reading: Vector6,
    wrench: Option<Vector6>,
    stiffness: Option<Matrix6>,
    bending: Option<[f64; 2]>,
    target: Option<Matrix6>,
}

impl Load {
    /// Add `p` units of an action.
    pub fn add(&mut self, action: &Action, p: f64) {
        match action {
            Action::Force(f) => self.force += p * f,
            Action::Elongation(e) => self.elongation += p * e,
            Action::Base(x) => self.base += p * x,
            Action::Plate(x) => self.plate += p * x,
            Action::Shift(a) => {
                let shift = self.shift.get_or_insert([Vector3::zeros(); 6]);
                for (sum, a) in shift.iter_mut().zip(a) {
                    *sum += p * a;
                }
            }
            Action::Bending(k) => {
                let bending = self.bending.get_or_insert([0.0; 2]);
                bending[0] += p * k[0];
                bending[1] += p * k[1];
            }
            Action::Joint { elongation, force } => {
                self.elongation += p * elongation;
                self.force += p * force;
            }
            Action::Frame { twist, force } => {
                self.plate += p * twist;
                self.force += p * force;
            }
            Action::Reading(y) => self.reading += p * y,
            Action::Wrench(w) => *self.wrench.get_or_insert_with(Vector6::zeros) += p * w,
            Action::Stiffness(k) => *self.stiffness.get_or_insert_with(Matrix6::zeros) += p * **k,
            Action::Target(d) => *self.target.get_or_insert_with(Matrix6::zeros) += p * **d,
        }
    }

    /// Add an action that acts leg by leg, another size of it in every leg.
    pub(crate) fn add_by_leg(&mut self, action: &Action, sizes: &Vector6) {
        match action {
            Action::Force(f) => self.force += f.component_mul(sizes),
            Action::Elongation(e) => self.elongation += e.component_mul(sizes),
            Action::Shift(a) => {
                let shift = self.shift.get_or_insert([Vector3::zeros(); 6]);
                for ((sum, a), p) in shift.iter_mut().zip(a).zip(sizes.iter()) {
                    *sum += *p * a;
                }
            }
            _ => {}
        }
    }

    /// Elongation of the legs between reference and load at the forces of a condition, m, displacements of their joints along them
    /// included; the springs have these compliances, m/N.
    pub(crate) fn stretch(&self, at: &Condition, compliances: &Vector6) -> Vector6 {
        let own = compliances.component_mul(&(at.spring_change() + self.force)) + self.elongation;
        self.shift.map_or(own, |shift| own + along(at, &shift))
    }

    /// True when something beside the springs may yield in the legs.
    pub(crate) fn stretches(&self) -> bool {
        self.shift.is_some() || self.force != Vector6::zeros() || self.elongation != Vector6::zeros()
    }

    /// Motion of the platform by what yields in series with all legs, geometric twist.
    pub(crate) fn twist(&self) -> Vector6 {
        self.base + self.plate
    }

    /// Extra wrench under the load.
    pub(crate) fn wrench(&self) -> Option<Vector6> {
        self.wrench
    }

    /// How the joints are displaced between reference and load; none where nothing does it.
    pub(crate) fn displacement(&self, at: &Condition) -> Option<JointDisplacement> {
        if self.shift.is_none() && self.twist() == Vector6::zeros() {
            return None;
        }
        let shift = self.shift.unwrap_or_default();
        let moved =
            |twist: &Vector6, arm: &Vector3| twist.fixed_rows::<3>(0) + twist.fixed_rows::<3>(3).cross(arm);
        let of_leg = |leg: usize| at.legs.arms[leg] - at.legs.directions[leg] * at.legs.lengths[leg];
        Some(JointDisplacement {
            base: std::array::from_fn(|leg| shift[leg] + moved(&self.base, &of_leg(leg))),
            platform: std::array::from_fn(|leg| -moved(&self.plate, &at.legs.arms[leg])),
        })
    }

    /// Displacement of the base joints on their brackets between reference and load; none where nothing displaces them.
    pub(crate) fn shift(&self) -> Option<[Vector3; 6]> {
        self.shift
    }

    /// What stands beside the legs at a condition; none where nothing does.
    pub(crate) fn beside(&self, at: &Condition) -> Option<BesideLegs> {
        if self.stiffness.is_none() && self.bending.is_none() {
            return None;
        }
        let bending = self.bending.unwrap_or_default();
        let stiffness = self.stiffness.unwrap_or_else(Matrix6::zeros) + bending::stiffness(&at.legs, bending);
        Some(BesideLegs { stiffness, bending })
    }
}

/// How joints are displaced against the drawing, fixed axes, m: base joints, and platform joints against the platform.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct JointDisplacement {
    base: [Vector3; 6],
    platform: [Vector3; 6],
}

impl JointDisplacement {
    /// This displacement and a share of another.
    pub(crate) fn and(&self, other: &Self, share: f64) -> Self {
        Self {
            base: std::array::from_fn(|leg| self.base[leg] + share * other.base[leg]),
            platform: std::array::from_fn(|leg| self.platform[leg] + share * other.platform[leg]),
        }
    }

    /// That of every base joint.
    pub(crate) fn base(&self) -> [Vector3; 6] {
        self.base
    }

    /// Base joints (fixed frame) and platform joints (mobile frame) of a machine at a pose.
    pub(crate) fn joints(&self, machine: &Machine, place: &Placement) -> [[Vector3; 6]; 2] {
        let rotation = place.rotation;
        [
            std::array::from_fn(|leg| machine.base_joints[leg] + self.base[leg]),
            std::array::from_fn(|leg| machine.platform_joints[leg] + rotation.tr_mul(&self.platform[leg])),
        ]
    }
}

/// What holds the platform beside the legs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BesideLegs {
    /// `K` at the mobile origin, fixed axes.
    pub(crate) stiffness: Matrix6,
    /// Stiffness of all joints against turns of their leg, base end and platform end.
    bending: [f64; 2],
}

impl BesideLegs {
    /// Wrench that holds the platform back when it has moved by a twist, and the base joints by `shift`: legs turn with both.
    pub(crate) fn held(&self, legs: &Legs, motion: &Vector6, shift: Option<&[Vector3; 6]>) -> Vector6 {
        let held = self.stiffness * motion;
        shift.map_or(held, |shift| held - bending::wrench(legs, self.bending, shift))
    }
}

/// Displacements of the base joints along their legs.
fn along(at: &Condition, shift: &[Vector3; 6]) -> Vector6 {
    Vector6::from_fn(|leg, _| at.legs.directions[leg].dot(&shift[leg]))
}

/// The chain at one condition and one set of parameter values: prediction and derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// `phi`, N.
    force: Vector6,
    /// Motion of the legs' platform against their base, geometric twist.
    elastic: Vector6,
    /// Motion of the platform, geometric twist.
    motion: Vector6,
    /// What the instrument adds, whitened.
    added: Vector6,
    /// Whitened observer with target terms: `W H (I + D)`.
    reader: Matrix6,
    /// Whitened observer `W H`.
    bare_reader: Matrix6,
    /// `(I + S K)^-1 J`.
    legs_to_motion: Matrix6,
    compliances: Vector6,
    /// Stiffness of the joints against turns of their leg.
    bending: Option<[f64; 2]>,
    /// Displacement of the base joints between reference and load.
    shift: Option<[Vector3; 6]>,
    /// Relief by K beyond what the forces have already, N.
    relief: Vector6,
}

impl Link {
    /// The chain of a condition under these compliances (m/N) and the summed actions `load`.
    pub fn at(condition: &Condition, compliances: &Vector6, load: &Load) -> Self {
        let j = condition.legs.platform_jacobian;
        let stretch = load.stretch(condition, compliances);
        let bare_reader = condition.weights.of(condition.observer);
        let reader = load.target.map_or(bare_reader, |d| bare_reader * (Matrix6::identity() + d));
        let (legs_to_motion, elastic, relief) = match load.beside(condition) {
            None => (j, j * stretch, Vector6::zeros()),
            Some(beside) => {
                let compliance = compliance(condition, compliances, |t| t.loaded);
                let legs_to_motion = against(&j, &compliance, &beside.stiffness) * j;
                let held = |motion: &Vector6| beside.held(&condition.legs, motion, load.shift.as_ref());
                let assumed = condition.relief - j.tr_mul(&held(&Vector6::zeros()));
                let elastic = legs_to_motion * (stretch + compliance * assumed);
                (legs_to_motion, elastic, j.tr_mul(&held(&elastic)) - condition.relief)
            }
        };
        Self {
            force: condition.spring_change() + load.force,
            elastic,
            motion: elastic + load.twist(),
            added: condition.weights.of(load.reading),
            reader,
            bare_reader,
            legs_to_motion,
            compliances: *compliances,
            bending: load.bending,
            shift: load.shift,
            relief,
        }
    }

    /// Motion of the platform, geometric twist at the mobile origin.
    pub fn motion(&self) -> Vector6 {
        self.motion
    }

    /// Predicted reading, whitened.
    pub fn prediction(&self) -> Vector6 {
        self.reader * self.motion + self.added
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
        let by_stretch = |e: &Vector6| self.legs_to_motion * e;
        let by_force = |f: &Vector6| self.legs_to_motion * self.yielding(condition, |t| &t.loaded, f);
        let j = &condition.legs.platform_jacobian;
        match action {
            Action::Force(f) => self.reader * by_stretch(&self.compliances.component_mul(f)),
            Action::Wrench(w) => self.reader * self.motion_by_wrench(condition, w),
            Action::Elongation(e) => self.reader * by_stretch(e),
            Action::Shift(a) => {
                let bent = self.bending.map(|k| j.tr_mul(&bending::wrench(&condition.legs, k, a)));
                let turned = bent.map_or_else(Vector6::zeros, |f| by_force(&f));
                self.reader * (by_stretch(&along(condition, a)) + turned)
            }
            Action::Base(x) | Action::Plate(x) => self.reader * x,
            Action::Joint { elongation, force } => self.reader * (by_stretch(elongation) + by_force(force)),
            Action::Frame { twist, force } => self.reader * (twist + by_force(force)),
            Action::Target(d) => self.bare_reader * (**d * self.motion),
            Action::Reading(y) => condition.weights.of(*y),
            Action::Stiffness(k) => {
                let beside = BesideLegs { stiffness: **k, bending: [0.0; 2] };
                self.reader * self.relieved(condition, &beside)
            }
            Action::Bending(k) => {
                let beside = BesideLegs { stiffness: bending::stiffness(&condition.legs, *k), bending: *k };
                self.reader * self.relieved(condition, &beside)
            }
        }
    }

    /// Motion of the platform by a change of the load.
    pub(crate) fn motion_by_wrench(&self, condition: &Condition, wrench: &Vector6) -> Vector6 {
        let forces = condition.legs.platform_jacobian.tr_mul(wrench);
        let series = condition.tangent.as_ref().map_or_else(Vector6::zeros, |t| t.series * wrench);
        self.legs_to_motion * self.yielding(condition, |t| &t.loaded, &forces) + series
    }

    /// Elongations of the legs by a change of their forces, by a tangent of a condition.
    fn yielding(&self, at: &Condition, of: fn(&Tangent) -> &Matrix6, force: &Vector6) -> Vector6 {
        at.tangent.as_deref().map_or_else(|| self.compliances.component_mul(force), |t| of(t) * force)
    }

    /// Motion of the platform when something more stands beside the legs.
    fn relieved(&self, at: &Condition, beside: &BesideLegs) -> Vector6 {
        let before = at.tangent.as_ref().map(|t| t.shift);
        let after = self.shift.map(|change| {
            let before = before.unwrap_or_default();
            std::array::from_fn(|leg| before[leg] + change[leg])
        });
        let held = |motion: &Vector6, shift: Option<&[Vector3; 6]>| {
            at.legs.platform_jacobian.tr_mul(&beside.held(&at.legs, motion, shift))
        };
        let loaded = self.yielding(at, |t| &t.loaded, &held(&(at.sag + self.elastic), after.as_ref()));
        let reference = self.yielding(at, |t| &t.reference, &held(&at.sag, before.as_ref()));
        -(self.legs_to_motion * (loaded - reference))
    }
}
