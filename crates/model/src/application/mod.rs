//! A fitted model at work: its file, predictions, corrected commands, the stiffness of the platform; the session it was found in.

pub mod compensate;
pub mod foresight;
pub mod model_file;
pub mod predict;
pub mod session;
pub mod stiffness;
