//! What only campaigns of absolute poses need.

use crate::metrology::Frames;
use hexbench_core::Pose;

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
