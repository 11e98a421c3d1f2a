//! Bodies and joints of a scene.

use hexbench_core::{Matrix6, Vector3};
use hexbench_truth::{TruthError, equilibrium::Body};
use rapier3d_f64::{math::Vector, prelude::*};

use super::{BodyScene, Leg, Yielding};
use crate::{convert, inexpressible, law, parts::Inertia};

/// Softness of a joint that shall have none.
const RIGID: SpringCoefficients<f64> = SpringCoefficients { natural_frequency: 1e9, damping_ratio: 1.0 };

const AXES: [JointAxis; 6] =
    [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ, JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ];

impl BodyScene {
    pub(super) fn insert(&mut self, place: &Body, inertia: &Inertia) -> RigidBodyHandle {
        let principal = Vector::from_array(inertia.principal);
        let body = RigidBodyBuilder::dynamic()
            .pose(convert::pose(place))
            .additional_mass_properties(MassProperties::new(Vector::ZERO, inertia.mass, principal))
            .linear_damping(self.dynamics.per_mass)
            .angular_damping(self.dynamics.per_mass)
            .gyroscopic_forces_enabled(false)
            .can_sleep(false);
        self.bodies.insert(body)
    }

    /// The base: fixed, or on six springs.
    pub(super) fn stand(&mut self) -> Result<(), TruthError> {
        let centre = self.setup.base_centre;
        let place = Body::upright(centre);
        let ground = self.bodies.insert(RigidBodyBuilder::fixed().pose(convert::pose(&place)));
        self.base = ground;
        let Some(compliance) = self.setup.base_compliance else { return Ok(()) };
        self.base = self.insert(&place, &self.dynamics.base.clone());
        self.support(self.base, ground, Vector3::zeros(), &compliance)
    }

    /// Six springs between a body and its support; `compliance` in the support's axes.
    pub(super) fn support(
        &mut self,
        body: RigidBodyHandle,
        support: RigidBodyHandle,
        centre: Vector3,
        compliance: &Matrix6,
    ) -> Result<(), TruthError> {
        let rigid = || inexpressible("a compliance with rigid directions");
        let stiffness = compliance.try_inverse().ok_or_else(rigid)?;
        let mut joint = GenericJointBuilder::new(JointAxesMask::empty())
            .local_anchor1(convert::to_engine(&centre))
            .contacts_enabled(false)
            .build();
        for (i, axis) in AXES.into_iter().enumerate() {
            self.spring(&mut joint, axis, stiffness[(i, i)], stiffness[(i, i)]);
        }
        self.joints.insert(support, body, joint, true);
        self.yielding.push(Yielding { body, support, centre, stiffness });
        Ok(())
    }

    /// Makes a motor a spring; `damped` is the stiffness that its damping is in proportion to.
    fn spring(&self, joint: &mut GenericJoint, axis: JointAxis, k: f64, damped: f64) {
        let damping = self.stepping.motor_damping(k, damped * self.dynamics.per_stiffness);
        joint.set_motor_model(axis, MotorModel::ForceBased).set_motor(axis, 0.0, 0.0, k, damping);
    }

    pub(super) fn add_leg(&mut self, i: usize) {
        let commanded = Body::at(&self.setup.pose);
        let foot = self.setup.base_joints[i];
        let span = commanded.origin + commanded.axes * self.setup.platform_joints[i] - foot;
        let length = span.norm();
        let axes = convert::axes_along(&(span / length));
        let mass = self.dynamics.half_leg;
        let inertia = Inertia { mass, principal: [mass * (0.5 * length).powi(2) / 12.0; 3] };
        let lower = self.insert(&Body { origin: foot + span * 0.25, axes }, &inertia);
        let upper = self.insert(&Body { origin: foot + span * 0.75, axes }, &inertia);
        let [kb, kp] = [self.setup.base_joint_stiffness, self.setup.platform_joint_stiffness];
        let in_base = convert::pose(&Body { origin: foot - self.setup.base_centre, axes });
        let in_plate = convert::pose(&Body {
            origin: self.setup.platform_joints[i],
            axes: commanded.axes.transpose() * axes,
        });
        let quarter = Vector::new(0.25 * length, 0.0, 0.0);
        let lower_ball = self.ball(in_base, -quarter, kb);
        let upper_ball = self.ball(in_plate, quarter, kp);
        let foot = self.joints.insert(self.base, lower, lower_ball, true);
        self.joints.insert(self.plate, upper, upper_ball, true);
        let stiffness = law::stiffest(&self.setup.laws[i]);
        let slide = self.slide(quarter, stiffness, 1.0 / self.setup.laws[i].compliance);
        let spring = self.joints.insert(lower, upper, slide, true);
        self.legs.push(Leg { lower, upper, foot, spring, zero_length: length, stiffness });
    }

    /// A prismatic joint with the spring of a leg.
    fn slide(&self, quarter: Vector, stiffness: f64, damped: f64) -> GenericJoint {
        let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_PRISMATIC_AXES)
            .local_anchor1(quarter)
            .local_anchor2(-quarter)
            .softness(RIGID)
            .contacts_enabled(false)
            .build();
        self.spring(&mut joint, JointAxis::LinX, stiffness, damped);
        joint
    }

    /// A ball joint that resists bending with `bending` (N m/rad) and lets the leg spin.
    fn ball(&self, in_body: Pose, in_leg: Vector, bending: f64) -> GenericJoint {
        let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_SPHERICAL_AXES)
            .local_frame1(in_body)
            .local_anchor2(in_leg)
            .softness(RIGID)
            .contacts_enabled(false)
            .build();
        if bending != 0.0 {
            self.spring(&mut joint, JointAxis::AngY, bending, bending);
            self.spring(&mut joint, JointAxis::AngZ, bending, bending);
        }
        joint
    }
}
