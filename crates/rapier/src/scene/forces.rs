//! Forces that are set anew at every step, from where the bodies are.

use hexbench_core::{Vector3, Vector6};
use hexbench_truth::equilibrium::Body;
use rapier3d_f64::prelude::*;

use super::BodyScene;
use crate::convert;

impl BodyScene {
    pub(super) fn apply_forces(&mut self) {
        for (_, body) in self.bodies.iter_mut() {
            body.reset_forces(false);
            body.reset_torques(false);
        }
        self.load();
        self.weigh();
        self.yield_fully();
        if !self.setup.brackets.is_empty() {
            self.move_feet();
        }
        self.retarget();
    }

    /// Wrench, point forces and cables on the loaded platform.
    fn load(&mut self) {
        let place = self.loaded();
        let (mut force, mut moment) = (self.setup.wrench.force, self.setup.wrench.moment);
        for dead in &self.setup.forces {
            force += dead.force;
            moment += (place.axes * dead.point).cross(&dead.force);
        }
        for cable in &self.setup.cables {
            let arm = place.axes * cable.attachment;
            let reach = cable.anchor - place.origin - arm;
            let pull = reach.normalize() * (cable.stiffness * (reach.norm() - cable.free_length));
            force += pull;
            moment += arm.cross(&pull);
        }
        push(&mut self.bodies[self.loaded], &force, &moment);
    }

    /// Half the weight of a leg in the middle of either half.
    fn weigh(&mut self) {
        for (leg, weight) in self.legs.iter().zip(&self.setup.joint_weights) {
            for half in [leg.lower, leg.upper] {
                push(&mut self.bodies[half], weight, &Vector3::zeros());
            }
        }
    }

    /// What a full stiffness matrix adds to the six motors on its diagonal. Moments are those conjugate to the rotation
    /// vector, to first order in it.
    fn yield_fully(&mut self) {
        for k in 0..self.yielding.len() {
            let spring = self.yielding[k];
            let (body, support) = (self.place(spring.body), self.place(spring.support));
            let arm = support.axes * spring.centre;
            let seat = Body { origin: support.origin + arm, axes: support.axes };
            let d = body.relative_to(&seat);
            let all = spring.stiffness * d;
            let motors = Vector6::from_fn(|i, _| spring.stiffness[(i, i)] * d[i]);
            let (turn, about) = (d.fixed_rows::<3>(3).into_owned(), all.fixed_rows::<3>(3).into_owned());
            let conjugate = about + 0.5 * turn.cross(&about);
            let force = seat.axes * (motors - all).fixed_rows::<3>(0);
            let moment = seat.axes * (motors.fixed_rows::<3>(3) - conjugate);
            push(&mut self.bodies[spring.body], &force, &moment);
            let lever = body.origin - support.origin;
            push(&mut self.bodies[spring.support], &-force, &(-moment - lever.cross(&force)));
        }
    }

    /// Turns the leg laws into targets of the motors: at rest `k (x - target)` is the force of the law.
    fn retarget(&mut self) {
        let (e, f) = (self.elongations(), self.forces());
        for (i, leg) in self.legs.iter().enumerate() {
            let target = self.setup.leg_lengths[i] + e[i] - f[i] / leg.stiffness - leg.zero_length;
            if let Some(joint) = self.joints.get_mut(leg.spring, false) {
                joint.data.motors[JointAxis::LinX as usize].target_pos = target;
            }
        }
    }

    /// Moves the base joints that yield to the leg forces.
    fn move_feet(&mut self) {
        let (plate, base, forces) = (self.plate(), self.base(), self.forces());
        let pulls: [Vector3; 6] =
            std::array::from_fn(|i| self.span(&plate, &base, i).normalize() * forces[i]);
        let mut feet = self.setup.base_joints.map(|a| a - self.setup.base_centre);
        for bracket in &self.setup.brackets {
            feet[bracket.displaced] += base.axes.tr_mul(&(bracket.compliance * pulls[bracket.pulled]));
        }
        for (leg, foot) in self.legs.iter().zip(feet) {
            if let Some(joint) = self.joints.get_mut(leg.foot, false) {
                joint.data.local_frame1.translation = convert::to_engine(&foot);
            }
        }
    }
}

fn push(body: &mut RigidBody, force: &Vector3, moment: &Vector3) {
    body.add_force(convert::to_engine(force), true);
    body.add_torque(convert::to_engine(moment), true);
}
