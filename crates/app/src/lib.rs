//! What the command and the Python package do alike, and the ways in which it fails: one text for both.
//!
//! Next to the proving ground, the sweeps and the workbench, this is a place that sees both worlds.

pub mod design;
pub mod failure;
pub mod fit;
pub mod input;
pub mod simulate;

pub use failure::{Exit, Failure};
