//! The instrument's own frames.

use hexbench_core::Pose;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Constant frames between the machine and what is read in absolute mode: reading = metrology * pose * target.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InstrumentFrames {
    /// Fixed frame of the machine seen from the instrument.
    pub metrology: Pose,
    /// Measured targets seen from the mobile frame.
    pub target: Pose,
}

impl InstrumentFrames {
    /// Frames as they are after a careful alignment: a tenth of a millimeter and some tenths of a milliradian off.
    pub fn aligned(rng: &mut Pcg64) -> Self {
        const MISALIGNED: [f64; 6] = [1e-4, 1e-4, 1e-4, 2e-4, 2e-4, 2e-4];
        let mut pose = || {
            Pose::from_array(MISALIGNED.map(|size| {
                let x: f64 = StandardNormal.sample(rng);
                size * x
            }))
        };
        Self { metrology: pose(), target: pose() }
    }

    /// Pose of the targets in the instrument's frame.
    pub fn seen(&self, pose: &Pose) -> Pose {
        let (m, x) = (self.metrology.rotation(), pose.rotation());
        let position = pose.translation + x * self.target.translation;
        Pose::from_rotation(self.metrology.translation + m * position, &(m * x * self.target.rotation()))
    }
}
