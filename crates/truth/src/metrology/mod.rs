//! Errors of the instrument: noise, blunders, frames; and poses measured with balls.

mod balls;
mod cmm;
mod frames;
mod noise;
mod sensors;

pub use balls::{Balls, Registration};
pub use cmm::{Cmm, CmmPose, CmmRecord, Surroundings};
pub use frames::InstrumentFrames;
pub use noise::InstrumentNoise;
pub use sensors::read_sensors;

use hexbench_core::{Matrix3, Pose};

/// Axes in fixed directions about which the Euler angles of a pose turn, as columns: rotation vector from changes of the
/// angles.
fn euler_axes(pose: &Pose) -> Matrix3 {
    let ((sb, cb), (sg, cg)) = (pose.angles.y.sin_cos(), pose.angles.z.sin_cos());
    Matrix3::new(cg * cb, -sg, 0.0, sg * cb, cg, 0.0, -sb, 0.0, 1.0)
}
