//! Where the platform stands, ready to be computed with.

use hexbench_core::{Matrix3, Pose, Vector3, Vector6};
use nalgebra::{Isometry3, Rotation3};

/// A pose with its rotation matrix instead of its angles. Fixed frame, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Position of the mobile origin.
    pub translation: Vector3,
    /// `R`: mobile axes to fixed axes.
    pub rotation: Matrix3,
}

impl Placement {
    /// The same with angles.
    pub fn pose(&self) -> Pose {
        Pose::from_rotation(self.translation, &self.rotation)
    }

    /// Angle between the z axes of platform and base, rad.
    pub fn tilt(&self) -> f64 {
        let lateral = self.rotation.m13.hypot(self.rotation.m23);
        lateral.atan2(self.rotation.m33)
    }

    /// After a share of a small geometric twist `[v; w]` at the mobile origin.
    #[must_use]
    pub fn moved(&self, twist: &Vector6, share: f64) -> Self {
        let turn = Rotation3::new(share * twist.fixed_rows::<3>(3));
        Self {
            translation: self.translation + share * twist.fixed_rows::<3>(0),
            rotation: turn.matrix() * self.rotation,
        }
    }
}

impl From<&Pose> for Placement {
    fn from(pose: &Pose) -> Self {
        Self { translation: pose.translation, rotation: pose.rotation() }
    }
}

impl From<&Isometry3<f64>> for Placement {
    fn from(motion: &Isometry3<f64>) -> Self {
        Self {
            translation: motion.translation.vector,
            rotation: *motion.rotation.to_rotation_matrix().matrix(),
        }
    }
}
