//! Bringing the forces of a condition to rest, and how the structure yields about them.

use hexbench_core::{Approach, Matrix6, Vector3, Vector6, Wrench};

use super::{Sag, Tangent, YieldingMachine};
use crate::effects::chain::{Action, BesideLegs, JointDisplacement, Load};
use crate::effects::term::Rich;
use crate::error::ModelError;
use crate::estimation::campaign::{Condition, LoadPath};
use crate::estimation::linearization::{Active, actions};
use crate::machine::geometry::Machine;
use crate::machine::kinematics::{Legs, forces_near};
use crate::machine::placement::Placement;

/// Steps of Newton's method; each gains the curvature of the legs times the share that stands beside them.
const MOST_STEPS: usize = 12;
/// Change of the relief, relative to the leg forces, at which it has settled: rounding of sums of six.
const SETTLED: f64 = 1e-14;
/// Step of the differences relative to the leg forces: laws bend over newtons, and rounding stays below 1e-9 of a compliance.
const STEP: f64 = 1e-6;

impl YieldingMachine<'_> {
    /// What the terms do together at a condition.
    pub(super) fn load(&self, at: &Condition, out: &mut Vec<Action>) -> Load {
        load(self.machine, at, self.active.iter().copied(), out)
    }

    /// Puts a condition halfway between its states, its legs loaded as statics says where they are. `displaced`: how the joints are in
    /// the two states; none: as drawn.
    pub(super) fn place(
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
        (at.place, at.legs) = (halfway, Legs::at(&base, &platform, halfway)?);
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
    pub(super) fn sag(&self, commanded: &Condition, out: &mut Vec<Action>) -> Sag {
        let j = commanded.legs.platform_jacobian;
        if self.active.is_empty() {
            let whole = j * self.compliances.component_mul(&commanded.reference_force);
            return Sag { of_legs: whole, whole, shift: None, displacement: None };
        }
        let mut at = commanded.alone();
        (at.wrench, at.reference) = (commanded.reference, Wrench::default());
        at.states[1].wrench = at.states[0].wrench;
        at.states[0].wrench = Vector6::zeros();
        at.set_forces([Vector6::zeros(), commanded.reference_force], &self.machine.friction_limits);
        let load = self.settle(&mut at, None, false, out);
        let of_legs = j * load.stretch(&at, self.compliances);
        let displacement = load.displacement(&at);
        Sag { of_legs, whole: of_legs + load.twist(), shift: load.shift(), displacement }
    }

    /// Motion of the measured platform between reference and load: to first order in it at the commanded pose, to second order halfway
    /// between the states. `shift` as of [`Self::settle`].
    pub(super) fn motion(
        &self,
        at: &Condition,
        shift: Option<[Vector3; 6]>,
        out: &mut Vec<Action>,
    ) -> Vector6 {
        let j = at.legs.platform_jacobian;
        if self.active.is_empty() {
            return j * self.compliances.component_mul(&at.force_change());
        }
        let mut at = at.clone();
        let load = self.settle(&mut at, shift, false, out);
        j * load.stretch(&at, self.compliances) + load.twist()
    }

    /// Brings the forces of a condition to rest, and says how the structure yields about them; what the terms do there.
    /// `shift`: displacement of the base joints on their brackets in the reference state.
    pub(super) fn settle(
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
            let mut exceeded = at.alone();
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
        let compliance = compliance(at, self.compliances, |t| t.loaded);
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
            let motion =
                by_stretch * (here.stretch(at, self.compliances) + compliance * (assumed + by_shift));
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
        let compliances = Matrix6::from_diagonal(self.compliances);
        let shift = shift.unwrap_or_default();
        let mut tangent =
            Tangent { loaded: compliances, reference: compliances, series: Matrix6::zeros(), shift };
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
        let stretch = self.load(at, out).stretch(at, self.compliances);
        let step = STEP * (1.0 + at.force.amax());
        let mut beside = at.clone();
        let mut columns = Matrix6::zeros();
        for leg in 0..6 {
            let mut forces = [at.reference_force, at.force];
            forces[state][leg] += step;
            beside.set_forces(forces, &self.machine.friction_limits);
            let moved = self.load(&beside, out).stretch(&beside, self.compliances);
            columns.set_column(leg, &((moved - stretch) / step));
        }
        columns
    }
}

impl Condition {
    /// The same without what came before the load and what comes with time: nothing has warmed, drifted or crept.
    fn alone(&self) -> Self {
        let mut alone = self.clone();
        alone.approach = Approach::Direct;
        alone.past.clear();
        (alone.put_on, alone.delta_t, alone.elapsed) = (0.0, 0.0, 0.0);
        alone
    }
}

/// A tangent compliance of a condition; without one, that of the springs.
pub(crate) fn compliance(at: &Condition, compliances: &Vector6, of: fn(&Tangent) -> Matrix6) -> Matrix6 {
    at.tangent.as_deref().map_or_else(|| Matrix6::from_diagonal(compliances), of)
}

/// `(I + J C J' K)^-1`: the share of a motion of the legs that a stiffness beside them leaves.
pub(crate) fn against(j: &Matrix6, compliance: &Matrix6, stiffness: &Matrix6) -> Matrix6 {
    let all = Matrix6::identity() + j * compliance * j.transpose() * stiffness;
    all.try_inverse().unwrap_or_else(Matrix6::identity)
}

/// Sum of what active terms do at a condition.
pub(super) fn load<'a>(
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
