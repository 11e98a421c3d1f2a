//! The structure at one moment: what the mechanisms have made of the nominal machine.

use hexbench_core::{Hexapod, Matrix3, Matrix6, Pose, Vector3, Wrench};

use crate::{Instant, LegLaw};

/// A dead force on the platform: constant direction in fixed axes, acting at a point of the mobile frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointForce {
    /// Where it acts, mobile frame, m.
    pub point: Vector3,
    /// Force, fixed axes, N.
    pub force: Vector3,
}

/// A spring between a fixed point and a point of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cable {
    /// Fixed end, fixed frame, m.
    pub anchor: Vector3,
    /// Platform end, mobile frame, m.
    pub attachment: Vector3,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Length without force, m.
    pub free_length: f64,
}

/// The pull of leg `pulled` moves the base joint of leg `displaced`: `u = compliance f n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// Leg whose base joint moves, from zero.
    pub displaced: usize,
    /// Leg whose force moves it, from zero.
    pub pulled: usize,
    /// Displacement per force, fixed axes, m/N.
    pub compliance: Matrix3,
}

/// Everything the equilibrium needs to know. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Commanded pose: where the solution is sought.
    pub pose: Pose,
    /// True base joints, fixed frame, m.
    pub base_joints: [Vector3; 6],
    /// True platform joints, mobile frame, m.
    pub platform_joints: [Vector3; 6],
    /// Leg lengths without force, m.
    pub leg_lengths: [f64; 6],
    /// Law of each leg.
    pub laws: [LegLaw; 6],
    /// Wrench at the mobile origin, fixed axes.
    pub wrench: Wrench,
    /// Further dead forces on the platform.
    pub forces: Vec<PointForce>,
    /// Cables pulling at the platform.
    pub cables: Vec<Cable>,
    /// Dead force that each leg puts on each of its two joints (half its weight), fixed axes, N.
    pub joint_weights: [Vector3; 6],
    /// Base joints that move under leg forces.
    pub brackets: Vec<Bracket>,
    /// Center at which the base yields, fixed frame, m.
    pub base_centre: Vector3,
    /// Compliance of the base at its center, fixed axes, [m/N, ; , rad/(N m)]; none: rigid.
    pub base_compliance: Option<Matrix6>,
    /// Compliance between the legs' plate and the measured, loaded platform, at the mobile origin, mobile axes; none: rigid.
    pub plate_compliance: Option<Matrix6>,
    /// Bending stiffness of each base joint, N m/rad.
    pub base_joint_stiffness: f64,
    /// Bending stiffness of each platform joint, N m/rad.
    pub platform_joint_stiffness: f64,
}

impl Setup {
    /// The nominal machine with plain springs at a moment; `leg_compliance` in m/N.
    pub fn nominal(moment: &Instant<'_>, leg_compliance: &[f64; 6], wrench: Wrench) -> Self {
        let Hexapod { base_joints, platform_joints, .. } = moment.hexapod;
        Self {
            pose: moment.situation.pose,
            base_joints: *base_joints,
            platform_joints: *platform_joints,
            leg_lengths: moment.nominal_lengths,
            laws: std::array::from_fn(|i| LegLaw {
                length: moment.nominal_lengths[i],
                ..LegLaw::spring(leg_compliance[i])
            }),
            wrench,
            forces: Vec::new(),
            cables: Vec::new(),
            joint_weights: [Vector3::zeros(); 6],
            brackets: Vec::new(),
            base_centre: moment.hexapod.base_centre(),
            base_compliance: None,
            plate_compliance: None,
            base_joint_stiffness: 0.0,
            platform_joint_stiffness: 0.0,
        }
    }

    /// Adds a compliance of the base in series with those already there.
    pub fn yield_base(&mut self, compliance: &Matrix6) {
        *self.base_compliance.get_or_insert_with(Matrix6::zeros) += compliance;
    }

    /// Adds a compliance of the plate in series with those already there.
    pub fn yield_plate(&mut self, compliance: &Matrix6) {
        *self.plate_compliance.get_or_insert_with(Matrix6::zeros) += compliance;
    }
}
