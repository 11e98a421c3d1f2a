//! A command as a function: inputs to results and pages, for the command line and the Python package alike, and the ways in which it
//! fails, in one text for both.
//!
//! Next to the experiments and the workbench, this is a place that sees both worlds.

pub mod design;
pub mod failure;
pub mod first_plan;
pub mod fit;
pub mod input;
pub mod memory;
pub mod session;
pub mod simulate;

pub use failure::{Exit, Failure};
