//! A fitted model at work: its file, predictions, corrected commands, the stiffness of the platform.

pub mod compensate;
pub mod model_file;
pub mod predict;
pub mod stiffness;
