//! The load on the platform.

use crate::{Vector3, Vector6};

/// Force (N) and moment (N m) applied to the platform, at the mobile origin, in fixed axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force, fixed axes, N.
    pub force: Vector3,
    /// Moment about the mobile origin, fixed axes, N m.
    pub moment: Vector3,
}

impl Wrench {
    /// Names of the six components, in the order of [`Self::to_array`].
    pub const NAMES: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

    /// A wrench from `[fx, fy, fz, mx, my, mz]` in N and N m.
    pub fn from_array(w: [f64; 6]) -> Self {
        Self { force: Vector3::new(w[0], w[1], w[2]), moment: Vector3::new(w[3], w[4], w[5]) }
    }

    /// `[fx, fy, fz, mx, my, mz]` in N and N m.
    pub fn to_array(self) -> [f64; 6] {
        [self.force.x, self.force.y, self.force.z, self.moment.x, self.moment.y, self.moment.z]
    }

    /// The wrench `factor` times as far from this one as `load` is.
    #[must_use]
    pub fn beyond(&self, load: &Self, factor: f64) -> Self {
        Self {
            force: self.force + (load.force - self.force) * factor,
            moment: self.moment + (load.moment - self.moment) * factor,
        }
    }

    /// The wrench as one vector `[F; M]`.
    pub fn to_vector(self) -> Vector6 {
        Vector6::from_column_slice(&self.to_array())
    }
}
