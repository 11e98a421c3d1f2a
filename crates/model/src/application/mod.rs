//! A fitted model in use: its file, predictions, corrected commands, stiffness of the platform, and the session in which it was
//! found.

pub mod compensate;
pub mod foresight;
pub mod model_file;
pub mod predict;
pub mod reach;
pub mod session;
pub mod stiffness;
