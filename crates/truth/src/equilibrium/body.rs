//! A rigid body: position and orientation.

use hexbench_core::{Matrix3, Pose, Vector3, Vector6};

use crate::so3;

/// Place of a rigid body in the fixed frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Its origin, m.
    pub origin: Vector3,
    /// Its axes.
    pub axes: Matrix3,
}

impl Body {
    /// A body at a pose.
    pub fn at(pose: &Pose) -> Self {
        Self { origin: pose.translation, axes: pose.rotation() }
    }

    /// A body with its origin at a point and its axes along the fixed ones.
    pub fn upright(origin: Vector3) -> Self {
        Self { origin, axes: Matrix3::identity() }
    }

    /// The body moved by a small translation of its origin and a rotation vector, both in fixed axes.
    #[must_use]
    pub fn moved(&self, translation: &Vector3, rotation: &Vector3) -> Self {
        Self { origin: self.origin + translation, axes: so3::exp(rotation) * self.axes }
    }

    /// Translation and rotation vector of this body relative to `other`, in the axes of `other`, m and rad.
    pub fn relative_to(&self, other: &Self) -> Vector6 {
        let u = other.axes.tr_mul(&(self.origin - other.origin));
        let w = so3::log(&other.axes.tr_mul(&self.axes));
        Vector6::new(u.x, u.y, u.z, w.x, w.y, w.z)
    }
}
