//! What only campaigns of absolute poses need.

use crate::metrology::InstrumentFrames;
use hexbench_core::Pose;

/// Frames with one of their twelve numbers changed (metrology first), m or rad.
pub(super) fn shifted(frames: &InstrumentFrames, k: usize, step: f64) -> InstrumentFrames {
    let (mut metrology, mut target) = (frames.metrology.to_array(), frames.target.to_array());
    if k < 6 {
        metrology[k] += step;
    } else {
        target[k - 6] += step;
    }
    InstrumentFrames { metrology: Pose::from_array(metrology), target: Pose::from_array(target) }
}
