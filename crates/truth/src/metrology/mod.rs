//! What the instrument adds to the pose it sees: noise, blunders, frames.

mod frames;
mod noise;

pub use frames::Frames;
pub use noise::Noise;
