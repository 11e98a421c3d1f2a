//! What only campaigns of absolute poses need.

use hexbench_core::Pose;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::metrology::Frames;

/// Frames with one of their twelve numbers changed (metrology first), m or rad.
pub(super) fn shifted(frames: &Frames, k: usize, step: f64) -> Frames {
    let (mut metrology, mut target) = (frames.metrology.to_array(), frames.target.to_array());
    if k < 6 {
        metrology[k] += step
    } else {
        target[k - 6] += step
    }
    Frames { metrology: Pose::from_array(metrology), target: Pose::from_array(target) }
}

/// Frames as they are after a careful alignment: some tenths of a millimetre and of a milliradian off.
pub(super) fn aligned(rng: &mut Pcg64) -> Frames {
    const MISALIGNED: f64 = 3e-4;
    let mut pose = || {
        Pose::from_array(std::array::from_fn(|_| {
            let x: f64 = StandardNormal.sample(rng);
            MISALIGNED * x
        }))
    };
    Frames { metrology: pose(), target: pose() }
}
