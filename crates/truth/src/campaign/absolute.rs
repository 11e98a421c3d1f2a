//! What only campaigns of absolute poses need.

use hexbench_core::Pose;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::metrology::Frames;

/// Frames with one of their twelve numbers changed (metrology first), m or rad.
pub(super) fn shifted(frames: &Frames, k: usize, step: f64) -> Frames {
    let (mut metrology, mut target) = (frames.metrology.to_array(), frames.target.to_array());
    if k < 6 {
        metrology[k] += step;
    } else {
        target[k - 6] += step;
    }
    Frames { metrology: Pose::from_array(metrology), target: Pose::from_array(target) }
}

/// Frames as they are after a careful alignment: a tenth of a millimetre and some tenths of a milliradian off.
pub(super) fn aligned(rng: &mut Pcg64) -> Frames {
    const MISALIGNED: [f64; 6] = [1e-4, 1e-4, 1e-4, 2e-4, 2e-4, 2e-4];
    let mut pose = || {
        Pose::from_array(MISALIGNED.map(|size| {
            let x: f64 = StandardNormal.sample(rng);
            size * x
        }))
    };
    Frames { metrology: pose(), target: pose() }
}
