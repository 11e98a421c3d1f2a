//! A fitted model at work: its file, predictions, corrected commands.

pub mod compensate;
pub mod model_file;
pub mod predict;
