//! What the instrument adds to the pose it sees: noise, blunders, frames; and poses by way of balls.

mod balls;
mod frames;
mod noise;

pub use balls::{Balls, Registration};
pub use frames::Frames;
pub use noise::Noise;
