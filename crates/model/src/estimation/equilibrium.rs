//! Where the machine comes to rest: leg forces, and how the structure yields about them, given all parameters.
//!
//! In each state `s`, reference and loaded, the legs and what stands beside them share the load:
//!
//! ```text
//! f_s = L_s^-T W_s - J' K d_s        leg forces, K the stiffness beside the legs
//! d_s = J e_s                        motion of the legs' platform against their base
//! e_s = e(f_s)                       elongation by the springs and *all* terms at these forces
//! ```
//!
//! One step of Newton's method with the tangent compliance `C = de/df` of all legs (6x6, off the diagonal where legs share a
//! bracket) is `d = (I + J C J' K)^-1 J (e + C r)`, `r` the relief `J' K d` assumed before. Without stiffness beside the legs the
//! forces are determined by statics and nothing is iterated. The tangent is taken from the laws of the terms themselves, by differences: a
//! term that is added takes part without a further word.

use hexbench_core::{Approach, Matrix3, Matrix6, Measurand, Observation, Pose, Vector3, Vector6, Wrench};

use crate::effects::chain::{Action, JointDisplacement, Load};
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, Condition, ConditionReadings, LoadPath, LoadState, moved};
use crate::estimation::frames::ReadingAxes;
use crate::estimation::linearization::{Active, actions};
use crate::estimation::parallel::try_map;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::{Legs, euler_rate_matrix, forces_near};

/// Steps of Newton's method; each gains the curvature of the legs times the share that stands beside them.
const MOST_STEPS: usize = 12;
/// Change of the relief, relative to the leg forces, at which it has settled: rounding of sums of six.
const SETTLED: f64 = 1e-14;
/// Step of the differences relative to the leg forces: laws bend over newtons, and rounding stays below 1e-9 of a compliance.
const STEP: f64 = 1e-6;

/// How the structure yields about the forces it carries.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tangent {
    /// Leg elongations by leg forces under the load, m/N (6x6); none: the springs alone.
    pub loaded: Option<Matrix6>,
    /// The same by those in the reference state.
    pub reference: Option<Matrix6>,
    /// Twist of what yields in series with all legs by the wrench at the mobile origin (6x6), fixed axes.
    pub series: Matrix6,
    /// Motion of the legs' platform against their base in the reference state, geometric twist.
    pub sag: Vector6,
    /// Displacement of the base joints on their brackets in the reference state, fixed axes, m; none where nothing displaces them.
    pub shift: Option<[Vector3; 6]>,
    /// Change of leg force between reference and load that stands beside the legs, N: `J' K d` as the forces have it.
    pub relief: Vector6,
}

impl Tangent {
    /// [`Tangent::loaded`] beside springs of these compliances.
    pub(crate) fn loaded(&self, springs: &Vector6) -> Matrix6 {
        self.loaded.unwrap_or_else(|| Matrix6::from_diagonal(springs))
    }

    /// [`Tangent::reference`] beside springs of these compliances.
    pub(crate) fn reference(&self, springs: &Vector6) -> Matrix6 {
        self.reference.unwrap_or_else(|| Matrix6::from_diagonal(springs))
    }
}

/// What lies between platform and ground.
struct Structure<'a> {
    machine: &'a Machine,
    springs: &'a Vector6,
    /// Terms that act at a condition; those that calibrate the machine are part of it.
    active: Vec<&'a Active>,
}

impl Campaign {
    /// Conditions of this campaign on a machine whose legs have these compliances (m/N), under active terms.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`] for the first pose in file order that is singular.
    pub fn conditions(
        &self,
        machine: &Machine,
        springs: &Vector6,
        active: &[Active],
    ) -> Result<Vec<Condition>, ModelError> {
        let active = active.iter().filter(|a| !a.term.calibrates()).collect();
        let structure = Structure { machine, springs, active };
        try_map(&self.groups, |g| self.condition(&structure, g))
    }

    fn condition(
        &self,
        structure: &Structure<'_>,
        group: &ConditionReadings,
    ) -> Result<Condition, ModelError> {
        let (o, machine) = (&group.mean, structure.machine);
        let mut out = Vec::new();
        let mut at = if self.is_absolute() {
            measured(machine, o)?
        } else {
            deflected(structure, o, self.measurand, &mut out)?
        };
        at.weight = Vector6::from_fn(|k, _| 1.0 / group.sigma[k]);
        at.observer = self.observer(machine, &at.pose, &o.measured);
        at.reading = if self.is_absolute() {
            // Exact closure at the measured pose: no forward kinematics is needed.
            at.observer * at.legs.platform_jacobian * (at.legs.lengths - at.commanded_lengths)
        } else {
            Vector6::from_column_slice(&o.measured)
        };
        structure.settle(&mut at, &mut out);
        Ok(at)
    }

    /// Measured coordinates from the geometric twist: Euler differences for Euler readings, and the lever arm of
    /// the target in absolute mode.
    fn observer(&self, machine: &Machine, pose: &Pose, measured: &[f64; 6]) -> Matrix6 {
        match self.measurand {
            Measurand::DeflectionRotationVector => return Matrix6::identity(),
            Measurand::DeflectionEuler => {
                let rates = ReadingAxes::default().rates(&pose.to_array());
                return observer_matrix(&Matrix3::identity(), &Vector3::zeros(), &rates);
            }
            Measurand::AbsolutePose => {}
        }
        let lever = pose.rotation() * machine.target_frame.translation.vector;
        let axes = *machine.metrology_frame.rotation.to_rotation_matrix().matrix();
        observer_matrix(&axes, &lever, &self.axes.rates(measured))
    }
}

/// `diag(I, rates) diag(axes, axes) [I, -[lever]x; 0, I]`.
fn observer_matrix(axes: &Matrix3, lever: &Vector3, rates: &Matrix3) -> Matrix6 {
    let mut h = Matrix6::zeros();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
    h.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-axes * lever.cross_matrix()));
    h.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rates * axes));
    h
}

/// A condition whose legs carry what statics says, not yet read.
fn standing(machine: &Machine, o: &Observation, pose: Pose, legs: Legs, states: [LoadState; 2]) -> Condition {
    let none = Vector6::zeros();
    let commanded_lengths = machine.commanded_lengths(&o.pose);
    Condition {
        pose,
        legs,
        commanded_lengths,
        extension: commanded_lengths - machine.home_lengths,
        wrench: o.wrench,
        reference: o.reference,
        states,
        force: none,
        reference_force: none,
        spring_forces: [none; 2],
        path: LoadPath { reference: none, extreme: none, load: none },
        tangent: Tangent::default(),
        approach: o.approach,
        delta_t: o.delta_t,
        elapsed: o.elapsed,
        reading: none,
        observer: Matrix6::identity(),
        weight: Vector6::repeat(1.0),
    }
}

/// Absolute mode: the measured pose, brought back to the platform, is the loaded pose. A pose is measured against nothing: its
/// reference is the unloaded machine.
fn measured(machine: &Machine, o: &Observation) -> Result<Condition, ModelError> {
    let pose = machine.platform_pose(&Pose::from_array(o.measured));
    let legs = machine.legs(&pose)?;
    let state = |wrench| LoadState { pose, wrench, directions: legs.directions, lengths: legs.lengths };
    let states = [Vector6::zeros(), machine.effective_wrench(&o.wrench, &pose)].map(state);
    let o = Observation { reference: Wrench::default(), ..*o };
    let mut at = standing(machine, &o, pose, legs, states);
    at.set_forces(states.map(|s| legs.forces(&s.wrench)), &machine.friction_limits);
    Ok(at)
}

/// Deflections: every force is taken where it acts and the motion is linearised halfway, so that what remains of
/// the finite deflection is of third order. The reference pose is the commanded one plus the small deflection that
/// the structure gives it; the loaded pose lies a measured deflection further.
fn deflected(
    structure: &Structure<'_>,
    o: &Observation,
    measurand: Measurand,
    out: &mut Vec<Action>,
) -> Result<Condition, ModelError> {
    let sag = structure.sag(o, out)?;
    let reference = moved(&o.pose, &sag.whole, 1.0);
    let mut motion = Vector6::from_column_slice(&o.measured);
    if measurand == Measurand::DeflectionEuler {
        let rotation = euler_rate_matrix(&o.pose.angles) * motion.fixed_rows::<3>(3);
        motion.fixed_rows_mut::<3>(3).copy_from(&rotation);
    }
    let poses = [0.0, 0.5, 1.0].map(|share| moved(&reference, &motion, share));
    let before = sag.displacement.unwrap_or_default();
    let first = structure.between(o, &poses, &[before, before])?;
    let change = structure.load(&first, out).displacement(&first);
    let mut at = match change {
        Some(change) => structure.between(o, &poses, &[before, before.and(&change, 1.0)])?,
        None => first,
    };
    at.tangent.sag = sag.of_legs;
    at.tangent.shift = sag.shift;
    Ok(at)
}

/// Deflection in the reference state, to first order.
struct Sag {
    /// Motion of the legs' platform against their base, geometric twist.
    of_legs: Vector6,
    /// Motion of the measured platform, geometric twist.
    whole: Vector6,
    /// Displacement of the base joints on their brackets.
    shift: Option<[Vector3; 6]>,
    /// Displacement of the joints by all that moves them.
    displacement: Option<JointDisplacement>,
}

impl Structure<'_> {
    /// What the terms do together at a condition.
    fn load(&self, at: &Condition, out: &mut Vec<Action>) -> Load {
        load(self.machine, at, self.active.iter().copied(), out)
    }

    /// A condition that stands halfway between reference and loaded pose, its legs loaded as statics says. `displaced`: how the
    /// joints are in the two states.
    fn between(
        &self,
        o: &Observation,
        [reference, halfway, loaded]: &[Pose; 3],
        displaced: &[JointDisplacement; 2],
    ) -> Result<Condition, ModelError> {
        let machine = self.machine;
        let mean = JointDisplacement::default().and(&displaced[0], 0.5).and(&displaced[1], 0.5);
        let [base, platform] = mean.joints(machine, halfway);
        let legs = Legs::at(&base, &platform, halfway)?;
        let state = |pose: &Pose, wrench: &Wrench, displaced: &JointDisplacement| {
            let wrench = machine.effective_wrench(wrench, pose);
            let [base, platform] = displaced.joints(machine, pose);
            let (force, spans) = forces_near(&legs, &base, &platform, pose, &wrench);
            let lengths = Vector6::from_fn(|leg, _| spans[leg].norm());
            let directions = std::array::from_fn(|leg| spans[leg] / lengths[leg]);
            (force, LoadState { pose: *pose, wrench, directions, lengths })
        };
        let before = state(reference, &o.reference, &displaced[0]);
        let after = state(loaded, &o.wrench, &displaced[1]);
        let mut at = standing(machine, o, *halfway, legs, [before.1, after.1]);
        at.set_forces([before.0, after.0], &machine.friction_limits);
        Ok(at)
    }

    /// The reference state: a load of its own on the unloaded machine, when nothing has yet warmed, drifted or crept.
    fn sag(&self, o: &Observation, out: &mut Vec<Action>) -> Result<Sag, ModelError> {
        let legs = self.machine.legs(&o.pose)?;
        let wrench = self.machine.effective_wrench(&o.reference, &o.pose);
        let force = legs.forces(&wrench);
        if self.active.is_empty() {
            let whole = legs.platform_jacobian * self.springs.component_mul(&force);
            return Ok(Sag { of_legs: whole, whole, shift: None, displacement: None });
        }
        let o = Observation {
            wrench: o.reference,
            reference: Wrench::default(),
            approach: Approach::Direct,
            delta_t: 0.0,
            elapsed: 0.0,
            ..*o
        };
        let states = [Vector6::zeros(), wrench].map(|wrench| LoadState {
            pose: o.pose,
            wrench,
            directions: legs.directions,
            lengths: legs.lengths,
        });
        let mut at = standing(self.machine, &o, o.pose, legs, states);
        at.set_forces([Vector6::zeros(), force], &self.machine.friction_limits);
        let load = self.settle(&mut at, out);
        let of_legs = at.legs.platform_jacobian * load.stretch(&at, self.springs);
        let displacement = load.displacement(&at);
        Ok(Sag { of_legs, whole: of_legs + load.twist(), shift: load.shift(), displacement })
    }

    /// Brings the forces of a condition to rest, and says how the structure yields about them; what the terms do there.
    fn settle(&self, at: &mut Condition, out: &mut Vec<Action>) -> Load {
        if self.active.is_empty() {
            return Load::default();
        }
        let load = self.load(at, out);
        if let Some(wrench) = load.wrench() {
            at.states[1].wrench += wrench;
            let forces = [at.reference_force, at.force + at.legs.forces(&wrench)];
            at.set_forces(forces, &self.machine.friction_limits);
        }
        self.set_tangent(at, &load, out);
        if load.beside(at).is_none() {
            return load;
        }
        self.relieve(at, out);
        self.load(at, out)
    }

    /// Takes off the legs what stands beside them, on every load of the way that leaves a trace.
    fn relieve(&self, at: &mut Condition, out: &mut Vec<Action>) {
        let slides = at.approach == Approach::Overloaded && self.machine.friction_limits.amax() > 0.0;
        let extreme = slides.then(|| {
            let mut exceeded =
                Condition { approach: Approach::Direct, delta_t: 0.0, elapsed: 0.0, ..at.clone() };
            exceeded.set_forces([at.reference_force, at.path.extreme], &self.machine.friction_limits);
            self.relieve_load(&mut exceeded, None, out);
            exceeded.force
        });
        self.relieve_load(at, extreme, out);
    }

    /// The same for the load alone, reached over known `extreme` leg forces.
    fn relieve_load(&self, at: &mut Condition, extreme: Option<Vector6>, out: &mut Vec<Action>) {
        let (j, compliance) = (at.legs.platform_jacobian, at.tangent.loaded(self.springs));
        let Some(beside) = self.load(at, out).beside(at) else { return };
        let by_stretch = against(&j, &compliance, &beside.stiffness) * j;
        let before = j.tr_mul(&beside.held(&at.legs, &at.tangent.sag, at.tangent.shift.as_ref()));
        let [reference, load] = [at.reference_force, at.force].map(|f| f - before);
        let small = SETTLED * at.force.amax();
        for _ in 0..MOST_STEPS {
            let assumed = at.tangent.relief;
            at.set_forces([reference, load - assumed], &self.machine.friction_limits);
            if let Some(extreme) = extreme {
                at.set_path(LoadPath { extreme, ..at.path }, &self.machine.friction_limits);
            }
            let here = self.load(at, out);
            let by_shift = -j.tr_mul(&beside.held(&at.legs, &Vector6::zeros(), here.shift().as_ref()));
            let motion = by_stretch * (here.stretch(at, self.springs) + compliance * (assumed + by_shift));
            at.tangent.relief = j.tr_mul(&(beside.stiffness * motion)) - by_shift;
            if (at.tangent.relief - assumed).amax() <= small {
                break;
            }
        }
    }

    /// Differences of what the terms do by the forces of each leg and by the wrench.
    fn set_tangent(&self, at: &mut Condition, load: &Load, out: &mut Vec<Action>) {
        if load.stretches() {
            let stretch = load.stretch(at, self.springs);
            let step = STEP * (1.0 + at.force.amax());
            let mut by = |side: usize| {
                let mut columns = Matrix6::zeros();
                for leg in 0..6 {
                    let mut beside = at.clone();
                    let mut forces = [at.reference_force, at.force];
                    forces[side][leg] += step;
                    beside.set_forces(forces, &self.machine.friction_limits);
                    let moved = self.load(&beside, out).stretch(&beside, self.springs);
                    columns.set_column(leg, &((moved - stretch) / step));
                }
                columns
            };
            (at.tangent.reference, at.tangent.loaded) = (Some(-by(0)), Some(by(1)));
        }
        if load.twist() != Vector6::zeros() {
            for axis in 0..6 {
                let mut beside = at.clone();
                beside.states[1].wrench[axis] += 1.0;
                let column = self.load(&beside, out).twist() - load.twist();
                at.tangent.series.set_column(axis, &column);
            }
        }
    }
}

/// `(I + J C J' K)^-1`: the share of a motion of the legs that a stiffness beside them leaves.
pub(crate) fn against(j: &Matrix6, compliance: &Matrix6, stiffness: &Matrix6) -> Matrix6 {
    let all = Matrix6::identity() + j * compliance * j.transpose() * stiffness;
    all.try_inverse().unwrap_or_else(Matrix6::identity)
}

/// Sum of what active terms do at a condition.
pub(crate) fn load<'a>(
    machine: &Machine,
    at: &Condition,
    active: impl Iterator<Item = &'a Active>,
    out: &mut Vec<Action>,
) -> Load {
    let mut load = Load::default();
    for a in active {
        actions(a.term.as_ref(), a.rich, a.shape, machine, at, out);
        for (action, value) in out.iter().zip(&a.values) {
            load.add(action, *value);
        }
    }
    load
}
