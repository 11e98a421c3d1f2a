//! The equilibrium of the machine: leg forces and deformations of the structure, for given parameters.
//!
//! In each state `s`, reference and loaded, the legs and the stiffness in parallel with them share the load:
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

mod observer;
mod rest;

use hexbench_core::{Channel, LoadSequence, Matrix6, Measurand, Observation, Pose, Vector3, Vector6, Wrench};

pub(crate) use self::observer::{observer_of, pose_curvature};
pub(crate) use self::rest::{against, compliance};
use crate::effects::chain::{Action, JointDisplacement, Load};
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, Condition, ConditionReadings, LoadPath, LoadState, PastState};
use crate::estimation::linearization::Active;
use crate::estimation::parallel::try_map;
use crate::estimation::reading_weights::ReadingWeights;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::{Legs, euler_rate_matrix, forces_near};
use crate::machine::placement::Placement;

/// Turn of the legs, rad, up to which a motion of first order tells where the platform goes: readings are then off by its square, a millionth
/// of the motion.
const STRAIGHT: f64 = 1e-3;

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

/// What active terms do together between the two states of a condition.
pub(crate) fn acting(machine: &Machine, at: &Condition, active: &[Active]) -> Load {
    rest::load(machine, at, active.iter(), &mut Vec::new())
}

/// What lies between platform and ground.
pub(crate) struct YieldingMachine<'a> {
    machine: &'a Machine,
    compliances: &'a Vector6,
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
        compliances: &Vector6,
        active: &[Active],
        tangents: Tangents,
    ) -> Result<Vec<Condition>, ModelError> {
        let structure = YieldingMachine::of(machine, compliances, active, tangents);
        let none = LegsOfPose::default;
        try_map(&self.groups, |g| self.condition(&structure, g, &g.mean, &mut none()).map(|(at, _)| *at))
    }

    /// Condition of readings taken under the inputs of `o`, and what the terms do together there; `last`: legs at the pose before. Boxed: it is
    /// handed on several times, and has kilobytes.
    pub(crate) fn condition(
        &self,
        structure: &YieldingMachine<'_>,
        group: &ConditionReadings,
        o: &Observation,
        last: &mut LegsOfPose,
    ) -> Result<(Box<Condition>, Load), ModelError> {
        let machine = structure.machine;
        let mut out = Vec::new();
        let sequence = group.sequence.as_deref();
        let (mut at, shift) = if self.is_absolute() {
            (measured(structure, o)?, None)
        } else {
            let measured = self.reads_poses.then_some((&o.measured, self.measurand));
            deflected(structure, o, sequence, measured, last, &mut out)?
        };
        at.weights = group.weights();
        (at.numbers, at.reads_pose) = (group.numbers(), group.channels == Channel::POSE);
        at.observer = self.observer(machine, &at.place, &o.measured);
        if !at.reads_pose {
            // Of the pose halfway between the states, so that what is left out is of third order in the deflection.
            at.observer = observer::looks(&self.hexapod, &group.channels, &at.place, &at.legs, &at.observer);
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
}

/// Legs at the last commanded pose, on one machine: loads are put on one after the other where the platform stands.
#[derive(Default)]
pub(crate) struct LegsOfPose(Option<(Pose, Placement, Legs)>);

impl LegsOfPose {
    fn at(&mut self, machine: &Machine, pose: &Pose) -> Result<(&Placement, &Legs), ModelError> {
        // Zero has two signs: what is the same stays so to the last bit.
        let bits = |pose: &Pose| pose.to_array().map(f64::to_bits);
        let known = self.0.take().filter(|(last, ..)| bits(last) == bits(pose));
        let (_, place, legs) = if let Some(known) = known {
            self.0.insert(known)
        } else {
            let place = Placement::from(pose);
            self.0.insert((*pose, place, machine.legs(place)?))
        };
        Ok((place, legs))
    }
}

/// A condition whose legs stand at a pose and carry there what statics says, not yet read.
fn standing(
    structure: &YieldingMachine<'_>,
    o: &Observation,
    sequence: Option<&LoadSequence>,
    place: Placement,
    legs: &Legs,
    commanded: &Placement,
) -> Box<Condition> {
    let machine = structure.machine;
    let none = Vector6::zeros();
    let commanded_lengths = machine.commanded_lengths(*commanded);
    let states = [&o.reference, &o.wrench].map(|wrench| LoadState {
        place,
        wrench: machine.effective_wrench(wrench, &place),
        directions: legs.directions,
        lengths: legs.lengths,
    });
    let mut at = Box::new(Condition {
        line: o.line,
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
        weights: ReadingWeights::one(),
        numbers: 6,
        reads_pose: true,
        compliances: *structure.compliances,
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
            let motion = self.legs.platform_jacobian * self.compliances.component_mul(&change);
            let place = origin.place.moved(&motion, 1.0);
            let wrench = machine.effective_wrench(&state.load.wrench, &place);
            let (base, platform) = (&machine.base_joints, &machine.platform_joints);
            state.change = forces_near(&self.legs, base, platform, &place, &wrench).0 - reference;
        }
    }
}

/// Absolute mode: the measured pose, brought back to the platform, is the loaded pose. A pose is measured against nothing: its
/// reference is the unloaded machine.
fn measured(structure: &YieldingMachine<'_>, o: &Observation) -> Result<Box<Condition>, ModelError> {
    let machine = structure.machine;
    let place = machine.platform_place(&Pose::from_array(o.measured));
    let o = Observation { reference: Wrench::default(), ..*o };
    Ok(standing(structure, &o, None, place, &machine.legs(place)?, &(&o.pose).into()))
}

/// Deflections: every force is taken where it acts and the motion is linearized halfway, so that what remains of
/// the finite deflection is of third order. The reference pose is the commanded one plus the small deflection that
/// the structure gives it; the loaded pose lies a measured deflection further, or one as the structure gives it where no pose was
/// measured: that one is computed once more halfway where the legs turn, for at the commanded pose it is of first order only. Also the displacement of the
/// base joints on their brackets in the reference state.
fn deflected(
    structure: &YieldingMachine<'_>,
    o: &Observation,
    sequence: Option<&LoadSequence>,
    measured: Option<(&[f64; 6], Measurand)>,
    last: &mut LegsOfPose,
    out: &mut Vec<Action>,
) -> Result<(Box<Condition>, Option<[Vector3; 6]>), ModelError> {
    let (commanded, legs) = last.at(structure.machine, &o.pose)?;
    let mut at = standing(structure, o, sequence, *commanded, legs, commanded);
    let commanded = *commanded;
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

impl<'a> YieldingMachine<'a> {
    /// Of a machine whose legs have these compliances (m/N), under active terms.
    pub(crate) fn of(
        machine: &'a Machine,
        compliances: &'a Vector6,
        active: &'a [Active],
        tangents: Tangents,
    ) -> Self {
        let (calibrating, active): (Vec<&Active>, Vec<&Active>) =
            active.iter().partition(|a| a.term.calibrates());
        // What calibrates the machine, its loads and joints, moves the forces of all legs.
        let with_tangent = tangents == Tangents::ForAll || !calibrating.is_empty();
        Self { machine, compliances, active, with_tangent }
    }
}

#[cfg(test)]
mod tests;
