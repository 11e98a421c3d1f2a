//! The hexapod as bodies and joints of the engine.
//!
//! Every leg is two bodies, uniform rods from a joint to the middle: a ball joint at either end, a prismatic joint with a
//! spring (a force-based motor) between them. The legs hold a plate; where the plate yields, the loaded platform is
//! a body of its own on six springs. The base is fixed, or a body on six springs.
//!
//! The engine's own defaults would spoil the answer; what is set here and why:
//!
//! - Its joints are soft and its sweeps start from nothing in every step: joints are made stiff beyond notice, and the
//!   number of sweeps has to suffice within one step.
//! - Gyroscopic moments are off: they act on the velocity that a step gains before the joints take it away again, and
//!   leave a moment of order `dt^2` on a body at rest.
//! - One substep, no relaxing pass, no sleep: loads follow the pose at every step.

mod forces;
mod links;

use hexbench_core::{Matrix6, Vector3};
use hexbench_truth::{LegMemory, Setup, TruthError, equilibrium::Body};
use rapier3d_f64::{math::Vector, prelude::*};

use crate::{
    convert, law,
    parts::{Dynamics, Stepping},
};

#[derive(Debug, Clone, Copy)]
struct Leg {
    lower: RigidBodyHandle,
    upper: RigidBodyHandle,
    foot: ImpulseJointHandle,
    spring: ImpulseJointHandle,
    /// Distance of the joints when the prismatic joint was at zero, m.
    zero_length: f64,
    /// Stiffness of the motor, N/m.
    stiffness: f64,
}

/// A body on six springs.
#[derive(Debug, Clone, Copy)]
struct Yielding {
    body: RigidBodyHandle,
    support: RigidBodyHandle,
    /// Center of the springs in the support's frame, m.
    centre: Vector3,
    /// Full stiffness at that center, the support's axes; the motors carry its diagonal.
    stiffness: Matrix6,
}

/// Bodies, joints and the forces between them.
pub struct BodyScene {
    setup: Setup,
    remembered: [LegMemory; 6],
    dynamics: Dynamics,
    stepping: Stepping,
    base: RigidBodyHandle,
    plate: RigidBodyHandle,
    loaded: RigidBodyHandle,
    legs: Vec<Leg>,
    yielding: Vec<Yielding>,
    unrest: f64,
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

impl BodyScene {
    /// The machine at its commanded pose, legs as long as the distance of their joints, at rest.
    ///
    /// # Errors
    /// [`TruthError::Inexpressible`]: a compliance with rigid directions.
    pub fn new(
        setup: &Setup,
        remembered: &[LegMemory; 6],
        dynamics: &Dynamics,
        stepping: &Stepping,
    ) -> Result<Self, TruthError> {
        let mut scene = Self::empty(setup, remembered, dynamics, stepping);
        let commanded = Body::at(&setup.pose);
        scene.stand()?;
        scene.plate = scene.insert(&commanded, &dynamics.plate);
        scene.loaded = scene.plate;
        if let Some(compliance) = &setup.plate_compliance {
            scene.loaded = scene.insert(&commanded, &dynamics.loaded);
            scene.support(scene.loaded, scene.plate, Vector3::zeros(), compliance)?;
        }
        for i in 0..6 {
            scene.add_leg(i);
        }
        Ok(scene)
    }

    fn empty(setup: &Setup, remembered: &[LegMemory; 6], dynamics: &Dynamics, stepping: &Stepping) -> Self {
        let parameters = IntegrationParameters {
            dt: stepping.dt,
            num_solver_iterations: 1,
            num_internal_pgs_iterations: stepping.sweeps,
            num_internal_stabilization_iterations: 0,
            warmstart_joints: true,
            max_ccd_substeps: 0,
            ..IntegrationParameters::default()
        };
        Self {
            setup: setup.clone(),
            remembered: *remembered,
            dynamics: *dynamics,
            stepping: *stepping,
            base: RigidBodyHandle::invalid(),
            plate: RigidBodyHandle::invalid(),
            loaded: RigidBodyHandle::invalid(),
            legs: Vec::with_capacity(6),
            yielding: Vec::new(),
            unrest: f64::INFINITY,
            pipeline: PhysicsPipeline::new(),
            parameters,
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
        }
    }

    fn place(&self, handle: RigidBodyHandle) -> Body {
        convert::body(self.bodies[handle].position())
    }

    /// Place of the base, its origin at the base center.
    pub fn base(&self) -> Body {
        self.place(self.base)
    }

    /// Place of the body that the legs hold.
    pub fn plate(&self) -> Body {
        self.place(self.plate)
    }

    /// Place of the loaded and measured platform.
    pub fn loaded(&self) -> Body {
        self.place(self.loaded)
    }

    /// From base joint to platform joint of a leg, m, fixed axes.
    fn span(&self, plate: &Body, base: &Body, i: usize) -> Vector3 {
        let head = plate.origin + plate.axes * self.setup.platform_joints[i];
        head - base.origin - base.axes * self.foot(i)
    }

    /// Base joint in the frame of the base body, m.
    fn foot(&self, i: usize) -> Vector3 {
        let joint = self.joints.get(self.legs[i].foot);
        joint.map_or_else(Vector3::zeros, |j| convert::from_engine(j.data.local_frame1.translation))
    }

    /// Elongations of the legs, m.
    pub fn elongations(&self) -> [f64; 6] {
        let (plate, base) = (self.plate(), self.base());
        std::array::from_fn(|i| self.span(&plate, &base, i).norm() - self.setup.leg_lengths[i])
    }

    /// Forces that the leg laws give at the present elongations, N.
    pub fn forces(&self) -> [f64; 6] {
        let e = self.elongations();
        std::array::from_fn(|i| law::tension(&self.setup.laws[i], e[i], self.remembered[i]))
    }

    /// Widest gap of a ball joint, m.
    pub fn gap(&self) -> f64 {
        let ends = |joint: &ImpulseJoint| {
            let lower = self.bodies[joint.body1()].position();
            let upper = self.bodies[joint.body2()].position();
            let a = lower.transform_point(joint.data.local_frame1.translation);
            (a - upper.transform_point(joint.data.local_frame2.translation)).length()
        };
        let is_ball = |joint: &&ImpulseJoint| joint.data.locked_axes == JointAxesMask::LOCKED_SPHERICAL_AXES;
        self.joints.iter().map(|(_, joint)| joint).filter(is_ball).map(ends).fold(0.0, f64::max)
    }

    /// Largest of the forces that only a moving machine has, N: inertia and drag of every body, dampers of the legs. What a
    /// structure is out of static balance is carried by these.
    pub fn unrest(&self) -> f64 {
        self.unrest
    }

    /// One time step.
    pub fn step(&mut self) {
        let before: Vec<Vector> = self.bodies.iter().map(|(_, b)| b.linvel()).collect();
        let stretched = self.elongations();
        self.apply_forces();
        self.pipeline.step(
            Vector::ZERO,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
        self.unrest = self.moving_forces(&before, &stretched);
    }

    fn moving_forces(&self, before: &[Vector], stretched: &[f64; 6]) -> f64 {
        let Stepping { dt, .. } = self.stepping;
        let Dynamics { per_mass, per_stiffness, .. } = self.dynamics;
        let on_body = |(b, &v): (&RigidBody, &Vector)| {
            b.mass() * ((b.linvel() - v).length() / dt + per_mass * b.linvel().length())
        };
        let now = self.elongations();
        let in_leg = |i: usize| {
            let rate = (now[i] - stretched[i]).abs() / dt;
            rate * per_stiffness / self.setup.laws[i].compliance
        };
        let bodies = self.bodies.iter().map(|(_, b)| b).zip(before).map(on_body);
        bodies.chain((0..6).map(in_leg)).fold(0.0, f64::max)
    }
}
