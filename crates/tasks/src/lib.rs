//! What the command and the Python package do alike, and the ways in which it fails: one text for both.
//!
//! Next to the proving ground, the sweeps and the workbench, this is a place that sees both worlds.

pub mod failure;

pub use failure::{Exit, Failure};
