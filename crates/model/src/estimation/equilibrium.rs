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

use hexbench_core::{
    Approach, Channel, Hexapod, LoadSequence, Matrix3, Matrix6, Measurand, Observation, Pose, PoseFunction,
    SensorKind, Vector3, Vector6, Wrench,
};

use crate::effects::chain::{Action, BesideLegs, JointDisplacement, Load};
use crate::effects::term::Rich;
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, Condition, ConditionReadings, LoadPath, LoadState, PastState};
use crate::estimation::frames::ReadingAxes;
use crate::estimation::linearization::{Active, actions};
use crate::estimation::parallel::try_map;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::{Legs, euler_rate_matrix, forces_near};
use crate::machine::placement::Placement;

/// Steps of Newton's method; each gains the curvature of the legs times the share that stands beside them.
const MOST_STEPS: usize = 12;
/// Change of the relief, relative to the leg forces, at which it has settled: rounding of sums of six.
const SETTLED: f64 = 1e-14;
/// Turn of the legs, rad, up to which a motion of first order tells where the platform goes: readings are then off by its square, a millionth
/// of the motion.
const STRAIGHT: f64 = 1e-3;
/// Step of the differences relative to the leg forces: laws bend over newtons, and rounding stays below 1e-9 of a compliance.
const STEP: f64 = 1e-6;
/// Step of the differences of a function of the pose, m and rad: what they leave out and what rounding adds are 1e-9 of lengths of a metre.
const POSE_STEP: f64 = 3e-5;
/// The same of its second differences: 1e-8 of them.
const CURVATURE_STEP: f64 = 1e-4;

/// How the structure yields about the forces it carries.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tangent {
    /// Leg elongations by leg forces under the load, m/N (6x6).
    pub loaded: Matrix6,
    /// The same by those in the reference state.
    pub reference: Matrix6,
    /// Twist of what yields in series with all legs by the wrench at the mobile origin (6x6), fixed axes.
    pub series: Matrix6,
    /// Displacement of the base joints on their brackets in the reference state, fixed axes, m.
    pub shift: [Vector3; 6],
}

/// When the tangent is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tangents {
    /// Where the forces, or the columns of the active terms themselves, depend on it.
    ForFit,
    /// Wherever terms are active: columns of any other term follow.
    ForAll,
}

/// What lies between platform and ground.
pub(crate) struct Structure<'a> {
    machine: &'a Machine,
    springs: &'a Vector6,
    /// Terms that act at a condition; those that calibrate the machine are part of it.
    active: Vec<&'a Active>,
    /// True when the tangent is wanted whatever the terms do.
    with_tangent: bool,
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
        tangents: Tangents,
    ) -> Result<Vec<Condition>, ModelError> {
        let structure = Structure::of(machine, springs, active, tangents);
        try_map(&self.groups, |g| self.condition(&structure, g, &g.mean).map(|(at, _)| *at))
    }

    /// Condition of readings taken under the inputs of `o`, and what the terms do together there. Boxed: it is handed on several times, and
    /// has kilobytes.
    pub(crate) fn condition(
        &self,
        structure: &Structure<'_>,
        group: &ConditionReadings,
        o: &Observation,
    ) -> Result<(Box<Condition>, Load), ModelError> {
        let machine = structure.machine;
        let mut out = Vec::new();
        let sequence = group.sequence.as_deref();
        let (mut at, shift) = if self.is_absolute() {
            (measured(structure, o)?, None)
        } else {
            let measured = self.reads_poses.then_some((&o.measured, self.measurand));
            deflected(structure, o, sequence, measured, &mut out)?
        };
        at.weight = Vector6::from_fn(|k, _| 1.0 / group.sigma[k]);
        (at.numbers, at.reads_pose) = (group.numbers(), group.channels == Channel::POSE);
        at.observer = self.observer(machine, &at.place, &o.measured);
        if !at.reads_pose {
            // Of the pose halfway between the states, so that what is left out is of third order in the deflection.
            at.observer = looks(&self.hexapod, &group.channels, &at.place, &at.legs, &at.observer);
        }
        at.reading = if self.is_absolute() {
            // Exact closure at the measured pose: no forward kinematics is needed.
            at.observer * at.legs.platform_jacobian * (at.legs.lengths - at.commanded_lengths)
        } else {
            Vector6::from_column_slice(&o.measured)
        };
        let load = structure.settle(&mut at, shift, structure.with_tangent, &mut out);
        // A wrench of the terms has changed the forces since.
        let load = if load.wrench().is_some() { structure.load(&at, &mut out) } else { load };
        Ok((at, load))
    }

    /// Measured coordinates from the geometric twist: Euler differences for Euler readings, and the lever arm of
    /// the target in absolute mode.
    fn observer(&self, machine: &Machine, place: &Placement, measured: &[f64; 6]) -> Matrix6 {
        match self.measurand {
            Measurand::DeflectionRotationVector | Measurand::DeflectionEuler => {
                return pose_numbers(self.measurand, place);
            }
            Measurand::AbsolutePose => {}
        }
        let lever = place.rotation * machine.target_frame.translation.vector;
        let axes = *machine.metrology_frame.rotation.to_rotation_matrix().matrix();
        observer_matrix(&axes, &lever, &self.axes.rates(measured))
    }
}

/// The six numbers of a deflection per unit of the geometric twist at the mobile origin.
fn pose_numbers(measurand: Measurand, place: &Placement) -> Matrix6 {
    if measurand != Measurand::DeflectionEuler {
        return Matrix6::identity();
    }
    observer_matrix(
        &Matrix3::identity(),
        &Vector3::zeros(),
        &ReadingAxes::default().rates(&place.pose().to_array()),
    )
}

/// What the numbers of a deflection read per unit of the geometric twist at the mobile origin, a row each.
pub(crate) fn observer_of(
    hexapod: &Hexapod,
    measurand: Measurand,
    channels: &[Channel; 6],
    pose: &Pose,
    legs: &Legs,
) -> Matrix6 {
    let place = pose.into();
    looks(hexapod, channels, &place, legs, &pose_numbers(measurand, &place))
}

/// The same, given the rows of all pose numbers.
fn looks(
    hexapod: &Hexapod,
    channels: &[Channel; 6],
    place: &Placement,
    legs: &Legs,
    pose_numbers: &Matrix6,
) -> Matrix6 {
    let rotation = place.rotation;
    let along = |u: &Vector3, arm: &Vector3| {
        let moment = arm.cross(u);
        Vector6::new(u.x, u.y, u.z, moment.x, moment.y, moment.z)
    };
    let row = |channel: Channel| match channel {
        Channel::Nothing => Vector6::zeros(),
        Channel::Pose(k) => pose_numbers.row(k).transpose(),
        Channel::Sensor { sensor, number } => match hexapod.sensors.get(sensor).map(|s| &s.kind) {
            Some(SensorKind::Distance { point, direction, .. }) => along(direction, &(rotation * point)),
            Some(SensorKind::Point { point, .. }) => along(&Vector3::ith(number, 1.0), &(rotation * point)),
            Some(SensorKind::Inclination { axis, .. }) => Vector6::new(0.0, 0.0, 0.0, axis.x, axis.y, axis.z),
            Some(SensorKind::LegLength { leg, .. }) => along(&legs.directions[*leg], &legs.arms[*leg]),
            Some(SensorKind::Function { of, .. }) => pose_rates(of, place),
            None => Vector6::zeros(),
        },
    };
    Matrix6::from_rows(&channels.map(|channel| row(channel).transpose()))
}

/// What a function of the pose changes per unit of the geometric twist at the mobile origin, fixed axes: central differences.
fn pose_rates(of: &PoseFunction, place: &Placement) -> Vector6 {
    let steps = [POSE_STEP, -POSE_STEP];
    let beside = |n: usize| place.moved(&Vector6::ith(n / 2, 1.0), steps[n % 2]).pose();
    let values = of.at::<12>(&std::array::from_fn(beside));
    Vector6::from_fn(|k, _| (values[2 * k] - values[2 * k + 1]) / (2.0 * POSE_STEP))
}

/// By how much a function of the pose reads a motion otherwise when the pose has moved by a twist before, to first order in both.
pub(crate) fn pose_curvature(of: &PoseFunction, place: &Placement, twist: &Vector6, motion: &Vector6) -> f64 {
    let sizes = [twist, motion].map(Vector6::norm);
    if sizes.contains(&0.0) {
        return 0.0;
    }
    let steps = [CURVATURE_STEP, -CURVATURE_STEP];
    let beside = |n: usize| {
        let turned = place.moved(twist, steps[n % 2] / sizes[0]);
        turned.moved(motion, steps[n / 2] / sizes[1]).pose()
    };
    let [both, after, before, none] = of.at::<4>(&std::array::from_fn(beside));
    (both - after - before + none) / (4.0 * CURVATURE_STEP.powi(2)) * sizes[0] * sizes[1]
}

/// `diag(I, rates) diag(axes, axes) [I, -[lever]x; 0, I]`.
fn observer_matrix(axes: &Matrix3, lever: &Vector3, rates: &Matrix3) -> Matrix6 {
    let mut h = Matrix6::zeros();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
    h.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-axes * lever.cross_matrix()));
    h.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rates * axes));
    h
}

/// A condition whose legs stand at a pose and carry there what statics says, not yet read.
fn standing(
    structure: &Structure<'_>,
    o: &Observation,
    sequence: Option<&LoadSequence>,
    place: Placement,
    legs: &Legs,
    commanded: &Placement,
) -> Box<Condition> {
    let machine = structure.machine;
    let none = Vector6::zeros();
    let commanded_lengths = machine.commanded_lengths(commanded);
    let states = [&o.reference, &o.wrench].map(|wrench| LoadState {
        place,
        wrench: machine.effective_wrench(wrench, &place),
        directions: legs.directions,
        lengths: legs.lengths,
    });
    let mut at = Box::new(Condition {
        place,
        legs: *legs,
        commanded_lengths,
        extension: commanded_lengths - machine.home_lengths,
        wrench: o.wrench,
        reference: o.reference,
        states,
        force: none,
        reference_force: none,
        spring_forces: [none; 2],
        path: LoadPath { reference: none, extreme: none, load: none },
        past: sequence.map_or_else(Vec::new, PastState::all),
        put_on: sequence.map_or(0.0, |way| way.put_on),
        overload: o.overload,
        sag: none,
        relief: none,
        tangent: None,
        approach: o.approach,
        delta_t: o.delta_t,
        elapsed: o.elapsed,
        reference_age: o.reference_age,
        reading: none,
        observer: Matrix6::identity(),
        weight: Vector6::repeat(1.0),
        numbers: 6,
        reads_pose: true,
        springs: *structure.springs,
    });
    let forces = states.map(|s| legs.forces(&s.wrench));
    at.set_past(machine, &forces[0]);
    at.set_forces(forces, &machine.friction_limits);
    at
}

impl PastState {
    /// The earlier loads of a sequence, before their forces are known.
    fn all(sequence: &LoadSequence) -> Vec<Self> {
        let none = Vector6::zeros();
        sequence.past.iter().map(|&load| Self { load, change: none, spring_forces: none }).collect()
    }
}

impl Condition {
    /// Leg forces under the earlier loads, where the springs let the platform stand under each; `reference`: those in the reference state.
    fn set_past(&mut self, machine: &Machine, reference: &Vector6) {
        let origin = self.states[0];
        for state in &mut self.past {
            let wrench = machine.effective_wrench(&state.load.wrench, &origin.place);
            let change = self.legs.forces(&(wrench - origin.wrench));
            let motion = self.legs.platform_jacobian * self.springs.component_mul(&change);
            let place = origin.place.moved(&motion, 1.0);
            let wrench = machine.effective_wrench(&state.load.wrench, &place);
            let (base, platform) = (&machine.base_joints, &machine.platform_joints);
            state.change = forces_near(&self.legs, base, platform, &place, &wrench).0 - reference;
        }
    }
}

/// Absolute mode: the measured pose, brought back to the platform, is the loaded pose. A pose is measured against nothing: its
/// reference is the unloaded machine.
fn measured(structure: &Structure<'_>, o: &Observation) -> Result<Box<Condition>, ModelError> {
    let machine = structure.machine;
    let place = machine.platform_place(&Pose::from_array(o.measured));
    let o = Observation { reference: Wrench::default(), ..*o };
    Ok(standing(structure, &o, None, place, &machine.legs(&place)?, &(&o.pose).into()))
}

/// Deflections: every force is taken where it acts and the motion is linearised halfway, so that what remains of
/// the finite deflection is of third order. The reference pose is the commanded one plus the small deflection that
/// the structure gives it; the loaded pose lies a measured deflection further, or one as the structure gives it where no pose was
/// measured: that one is computed once more halfway where the legs turn, for at the commanded pose it is of first order only. Also the displacement of the
/// base joints on their brackets in the reference state.
fn deflected(
    structure: &Structure<'_>,
    o: &Observation,
    sequence: Option<&LoadSequence>,
    measured: Option<(&[f64; 6], Measurand)>,
    out: &mut Vec<Action>,
) -> Result<(Box<Condition>, Option<[Vector3; 6]>), ModelError> {
    let commanded = Placement::from(&o.pose);
    let mut at =
        standing(structure, o, sequence, commanded, &structure.machine.legs(&commanded)?, &commanded);
    let sag = structure.sag(&at, out);
    let before = sag.displacement.unwrap_or_default();
    let displaced =
        structure.load(&at, out).displacement(&at).map(|change| [before, before.and(&change, 1.0)]);
    let reference = commanded.moved(&sag.whole, 1.0);
    let motion = match measured {
        None => structure.motion(&at, None, out),
        Some((measured, measurand)) => {
            let mut motion = Vector6::from_column_slice(measured);
            if measurand == Measurand::DeflectionEuler {
                let rotation = euler_rate_matrix(&o.pose.angles) * motion.fixed_rows::<3>(3);
                motion.fixed_rows_mut::<3>(3).copy_from(&rotation);
            }
            motion
        }
    };
    let place = |at: &mut Condition, motion: &Vector6| {
        let [halfway, loaded] = [0.5, 1.0].map(|share| reference.moved(motion, share));
        structure.place(at, halfway, [reference, loaded], displaced.as_ref())
    };
    place(&mut at, &motion)?;
    at.sag = sag.of_legs;
    if measured.is_none() && at.legs.turn(&motion) > STRAIGHT {
        let motion = structure.motion(&at, sag.shift, out);
        place(&mut at, &motion)?;
    }
    Ok((at, sag.shift))
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

impl<'a> Structure<'a> {
    /// Of a machine whose legs have these compliances (m/N), under active terms.
    pub(crate) fn of(
        machine: &'a Machine,
        springs: &'a Vector6,
        active: &'a [Active],
        tangents: Tangents,
    ) -> Self {
        let (calibrating, active): (Vec<&Active>, Vec<&Active>) =
            active.iter().partition(|a| a.term.calibrates());
        // What calibrates the machine, its loads and joints, moves the forces of all legs.
        let with_tangent = tangents == Tangents::ForAll || !calibrating.is_empty();
        Self { machine, springs, active, with_tangent }
    }
}

impl Structure<'_> {
    /// The calibrated machine.
    pub(crate) fn machine(&self) -> &Machine {
        self.machine
    }

    /// What the terms do together at a condition.
    fn load(&self, at: &Condition, out: &mut Vec<Action>) -> Load {
        load(self.machine, at, self.active.iter().copied(), out)
    }

    /// Puts a condition halfway between its states, its legs loaded as statics says where they are. `displaced`: how the joints are in
    /// the two states; none: as drawn.
    fn place(
        &self,
        at: &mut Condition,
        halfway: Placement,
        places: [Placement; 2],
        displaced: Option<&[JointDisplacement; 2]>,
    ) -> Result<(), ModelError> {
        let machine = self.machine;
        let joints = |place: &Placement, displaced: Option<JointDisplacement>| {
            displaced.map_or([machine.base_joints, machine.platform_joints], |d| d.joints(machine, place))
        };
        let mean = displaced.map(|[a, b]| JointDisplacement::default().and(a, 0.5).and(b, 0.5));
        let [base, platform] = joints(&halfway, mean);
        (at.place, at.legs) = (halfway, Legs::at(&base, &platform, &halfway)?);
        let mut forces = [Vector6::zeros(); 2];
        for (k, wrench) in [at.reference, at.wrench].iter().enumerate() {
            let (state, place) = (&mut at.states[k], places[k]);
            let [base, platform] = joints(&place, displaced.map(|d| d[k]));
            (state.place, state.wrench) = (place, machine.effective_wrench(wrench, &place));
            let (force, spans) = forces_near(&at.legs, &base, &platform, &place, &state.wrench);
            state.lengths = Vector6::from_fn(|leg, _| spans[leg].norm());
            state.directions = std::array::from_fn(|leg| spans[leg] / state.lengths[leg]);
            forces[k] = force;
        }
        at.set_past(machine, &forces[0]);
        at.set_forces(forces, &machine.friction_limits);
        Ok(())
    }

    /// The reference state of a condition at its commanded pose: a load of its own on the unloaded machine, when nothing has yet
    /// warmed, drifted or crept.
    fn sag(&self, commanded: &Condition, out: &mut Vec<Action>) -> Sag {
        let j = commanded.legs.platform_jacobian;
        if self.active.is_empty() {
            let whole = j * self.springs.component_mul(&commanded.reference_force);
            return Sag { of_legs: whole, whole, shift: None, displacement: None };
        }
        let mut at = Condition {
            wrench: commanded.reference,
            reference: Wrench::default(),
            approach: Approach::Direct,
            past: Vec::new(),
            put_on: 0.0,
            delta_t: 0.0,
            elapsed: 0.0,
            ..commanded.clone()
        };
        at.states[1].wrench = at.states[0].wrench;
        at.states[0].wrench = Vector6::zeros();
        at.set_forces([Vector6::zeros(), commanded.reference_force], &self.machine.friction_limits);
        let load = self.settle(&mut at, None, false, out);
        let of_legs = j * load.stretch(&at, self.springs);
        let displacement = load.displacement(&at);
        Sag { of_legs, whole: of_legs + load.twist(), shift: load.shift(), displacement }
    }

    /// Motion of the measured platform between reference and load: to first order in it at the commanded pose, to second order halfway
    /// between the states. `shift` as of [`Self::settle`].
    fn motion(&self, at: &Condition, shift: Option<[Vector3; 6]>, out: &mut Vec<Action>) -> Vector6 {
        let j = at.legs.platform_jacobian;
        if self.active.is_empty() {
            return j * self.springs.component_mul(&at.force_change());
        }
        let mut at = at.clone();
        let load = self.settle(&mut at, shift, false, out);
        j * load.stretch(&at, self.springs) + load.twist()
    }

    /// Brings the forces of a condition to rest, and says how the structure yields about them; what the terms do there.
    /// `shift`: displacement of the base joints on their brackets in the reference state.
    fn settle(
        &self,
        at: &mut Condition,
        shift: Option<[Vector3; 6]>,
        with_tangent: bool,
        out: &mut Vec<Action>,
    ) -> Load {
        if self.active.is_empty() {
            return Load::default();
        }
        let load = self.load(at, out);
        if let Some(wrench) = load.wrench() {
            at.states[1].wrench += wrench;
            let forces = [at.reference_force, at.force + at.legs.forces(&wrench)];
            at.set_forces(forces, &self.machine.friction_limits);
        }
        let beside = load.beside(at);
        if with_tangent || beside.is_some() {
            at.tangent = Some(Box::new(self.tangent(at, shift, &load, out)));
        }
        let Some(beside) = beside else { return load };
        self.relieve(at, &beside, out);
        self.load(at, out)
    }

    /// Takes off the legs what stands beside them, on every load of the way that leaves a trace.
    fn relieve(&self, at: &mut Condition, beside: &BesideLegs, out: &mut Vec<Action>) {
        let mut relieved = |forces: Vector6| {
            let mut exceeded = Condition {
                approach: Approach::Direct,
                past: Vec::new(),
                put_on: 0.0,
                delta_t: 0.0,
                elapsed: 0.0,
                ..at.clone()
            };
            exceeded.set_forces([at.reference_force, forces], &self.machine.friction_limits);
            self.relieve_load(&mut exceeded, beside, None, out);
            exceeded
        };
        let slides = at.approach == Approach::Overloaded && self.machine.friction_limits.amax() > 0.0;
        let extreme = slides.then(|| relieved(at.path.extreme).force);
        let past = at.past.iter().map(|state| relieved(at.reference_force + state.change).force_change());
        let changes: Vec<Vector6> = past.collect();
        at.past.iter_mut().zip(changes).for_each(|(state, change)| state.change = change);
        self.relieve_load(at, beside, extreme, out);
    }

    /// The same for the load alone, reached over known `extreme` leg forces.
    fn relieve_load(
        &self,
        at: &mut Condition,
        beside: &BesideLegs,
        extreme: Option<Vector6>,
        out: &mut Vec<Action>,
    ) {
        let (j, limits) = (at.legs.platform_jacobian, &self.machine.friction_limits);
        let compliance = compliance(at, self.springs, |t| t.loaded);
        let by_stretch = against(&j, &compliance, &beside.stiffness) * j;
        let shift_before = at.tangent.as_ref().map(|t| t.shift);
        let before = j.tr_mul(&beside.held(&at.legs, &at.sag, shift_before.as_ref()));
        let [reference, load] = [at.reference_force, at.force].map(|f| f - before);
        let small = SETTLED * at.force.amax();
        for _ in 0..MOST_STEPS {
            let assumed = at.relief;
            at.set_forces([reference, load - assumed], limits);
            if let Some(extreme) = extreme {
                at.set_path(LoadPath { extreme, ..at.path }, limits);
            }
            let here = self.load(at, out);
            let by_shift = -j.tr_mul(&beside.held(&at.legs, &Vector6::zeros(), here.shift().as_ref()));
            let motion = by_stretch * (here.stretch(at, self.springs) + compliance * (assumed + by_shift));
            at.relief = j.tr_mul(&(beside.stiffness * motion)) - by_shift;
            if (at.relief - assumed).amax() <= small {
                break;
            }
        }
    }

    /// Differences of what the terms do by the forces of each leg and by the wrench.
    fn tangent(
        &self,
        at: &Condition,
        shift: Option<[Vector3; 6]>,
        load: &Load,
        out: &mut Vec<Action>,
    ) -> Tangent {
        let springs = Matrix6::from_diagonal(self.springs);
        let shift = shift.unwrap_or_default();
        let mut tangent = Tangent { loaded: springs, reference: springs, series: Matrix6::zeros(), shift };
        if load.stretches() {
            let yielding = self.only(at, Load::stretches, out);
            tangent.loaded = yielding.by_forces(at, 1, out);
            if at.sag != Vector6::zeros() {
                tangent.reference = -yielding.by_forces(at, 0, out);
            }
        }
        if load.twist() != Vector6::zeros() {
            let bodies = self.only(at, |load| load.twist() != Vector6::zeros(), out);
            let mut beside = at.clone();
            for axis in 0..6 {
                beside.states[1].wrench[axis] += 1.0;
                tangent.series.set_column(axis, &(bodies.load(&beside, out).twist() - load.twist()));
                beside.states[1].wrench[axis] = at.states[1].wrench[axis];
            }
        }
        tangent
    }

    /// The structure with those of its terms alone that do something at a condition.
    fn only(&self, at: &Condition, does: impl Fn(&Load) -> bool, out: &mut Vec<Action>) -> Self {
        let own = self.active.iter().filter(|a| does(&load(self.machine, at, std::iter::once(**a), out)));
        Self { active: own.copied().collect(), ..*self }
    }

    /// Elongations by the leg forces of one state (6x6).
    fn by_forces(&self, at: &Condition, state: usize, out: &mut Vec<Action>) -> Matrix6 {
        let stretch = self.load(at, out).stretch(at, self.springs);
        let step = STEP * (1.0 + at.force.amax());
        let mut beside = at.clone();
        let mut columns = Matrix6::zeros();
        for leg in 0..6 {
            let mut forces = [at.reference_force, at.force];
            forces[state][leg] += step;
            beside.set_forces(forces, &self.machine.friction_limits);
            let moved = self.load(&beside, out).stretch(&beside, self.springs);
            columns.set_column(leg, &((moved - stretch) / step));
        }
        columns
    }
}

/// A tangent compliance of a condition; without one, that of the springs.
pub(crate) fn compliance(at: &Condition, springs: &Vector6, of: fn(&Tangent) -> Matrix6) -> Matrix6 {
    at.tangent.as_deref().map_or_else(|| Matrix6::from_diagonal(springs), of)
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
        if let Some(action) = a.term.together(machine, at, &a.values) {
            load.add(&action, 1.0);
            continue;
        }
        // What differs from leg to leg in its size alone is one action with six sizes.
        let by_leg = a.rich && a.term.info().rich == Rich::PerLeg;
        actions(a.term.as_ref(), a.rich && !by_leg, a.shape, machine, at, out);
        for (action, value) in out.iter().zip(&a.values) {
            load.add(action, *value);
        }
        if let Some(common) = out.first().filter(|_| by_leg) {
            load.add_by_leg(common, &Vector6::from_column_slice(&a.values[out.len()..]));
        }
    }
    load
}

#[cfg(test)]
mod tests;
