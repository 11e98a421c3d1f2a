//! The instrument's own frames.

use hexbench_core::Pose;

/// Constant frames between the machine and what is read in absolute mode: reading = metrology * pose * target.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Frames {
    /// Fixed frame of the machine seen from the instrument.
    pub metrology: Pose,
    /// Measured targets seen from the mobile frame.
    pub target: Pose,
}

impl Frames {
    /// Pose of the targets in the instrument's frame.
    pub fn seen(&self, pose: &Pose) -> Pose {
        let (m, x) = (self.metrology.rotation(), pose.rotation());
        let position = pose.translation + x * self.target.translation;
        Pose::from_rotation(self.metrology.translation + m * position, &(m * x * self.target.rotation()))
    }
}
