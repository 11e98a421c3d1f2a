//! The machine as the model currently believes it: nominal joints plus what calibration added.

use hexbench_core::{Hexapod, Pose, Vector3, Vector6, Wrench};
use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};

use crate::error::ModelError;
use crate::machine::kinematics::{Legs, leg_lengths};
use crate::machine::placement::Placement;

/// Joints and frames at the current point of linearization.
#[derive(Debug, Clone)]
pub struct Machine {
    /// The machine on the drawing; commanded lengths come from it.
    pub nominal: Hexapod,
    /// `A_i` as calibrated, fixed frame, m.
    pub base_joints: [Vector3; 6],
    /// `B_i` as calibrated, mobile frame, m.
    pub platform_joints: [Vector3; 6],
    /// Fixed frame seen from the metrology frame (absolute mode).
    pub metrology_frame: Isometry3<f64>,
    /// Target frame seen from the mobile frame (absolute mode).
    pub target_frame: Isometry3<f64>,
    /// Leg lengths at the zero pose, nominal, m.
    pub home_lengths: Vector6,
    /// Directions of the legs at the zero pose, base joint to platform joint, nominal, fixed frame.
    pub home_directions: [Vector3; 6],
    /// Pairs of legs that share a bracket, from zero.
    pub bracket_pairs: Vec<[usize; 2]>,
    /// Center of the base-joint plane, fixed frame, m.
    pub base_centre: Vector3,
    /// Where the load acts, mobile frame, m; the mobile origin unless found otherwise.
    pub load_point: Vector3,
    /// Small rotation of all loads, fixed axes, rad.
    pub load_tilt: Vector3,
    /// Dry friction beside each leg spring, N.
    pub friction_limits: Vector6,
}

impl Machine {
    /// The machine exactly as drawn.
    pub fn nominal(hexapod: &Hexapod) -> Self {
        Self {
            nominal: hexapod.clone(),
            base_joints: hexapod.base_joints,
            platform_joints: hexapod.platform_joints,
            metrology_frame: Isometry3::identity(),
            target_frame: Isometry3::identity(),
            home_lengths: leg_lengths(&hexapod.base_joints, &hexapod.platform_joints, &Pose::default()),
            home_directions: std::array::from_fn(|leg| {
                (hexapod.platform_joints[leg] - hexapod.base_joints[leg]).normalize()
            }),
            bracket_pairs: hexapod.bracket_pairs(),
            base_centre: hexapod.base_centre(),
            load_point: Vector3::zeros(),
            load_tilt: Vector3::zeros(),
            friction_limits: Vector6::zeros(),
        }
    }

    /// Legs of the calibrated machine at a pose.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn legs(&self, place: impl Into<Placement>) -> Result<Legs, ModelError> {
        Legs::at(&self.base_joints, &self.platform_joints, place)
    }

    /// Lengths the controller commands: inverse kinematics of the nominal machine, m.
    pub fn commanded_lengths(&self, place: impl Into<Placement>) -> Vector6 {
        leg_lengths(&self.nominal.base_joints, &self.nominal.platform_joints, place)
    }

    /// The wrench that acts at the mobile origin when the load is offset and tilted.
    pub fn effective_wrench(&self, wrench: &Wrench, place: &Placement) -> Vector6 {
        if self.load_tilt == Vector3::zeros() && self.load_point == Vector3::zeros() {
            return wrench.to_vector();
        }
        let force = Rotation3::new(self.load_tilt) * wrench.force;
        let moment = wrench.moment + (place.rotation * self.load_point).cross(&force);
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }

    /// The platform pose behind a reading of the target: `M^-1 X T^-1`.
    pub fn platform_place(&self, measured: &Pose) -> Placement {
        (&(self.metrology_frame.inverse() * isometry(measured) * self.target_frame.inverse())).into()
    }

    /// The reading the metrology would give of a platform pose: `M X T`.
    pub fn target_pose(&self, platform: &Pose) -> Pose {
        pose(&(self.metrology_frame * isometry(platform) * self.target_frame))
    }
}

/// A pose as a rigid transformation.
pub fn isometry(pose: &Pose) -> Isometry3<f64> {
    let rotation = Rotation3::from_matrix_unchecked(pose.rotation());
    Isometry3::from_parts(
        Translation3::from(pose.translation),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

/// A rigid transformation as a pose.
pub fn pose(isometry: &Isometry3<f64>) -> Pose {
    Pose::from_rotation(isometry.translation.vector, isometry.rotation.to_rotation_matrix().matrix())
}

/// Rigid transformation of a small motion `[v; rotation vector]`.
pub fn exponential(motion: &Vector6) -> Isometry3<f64> {
    let (v, w) = (motion.fixed_rows::<3>(0).into_owned(), motion.fixed_rows::<3>(3).into_owned());
    Isometry3::new(v, w)
}
