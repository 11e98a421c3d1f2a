//! Commands as functions that the command line and the Python package share: from inputs to results and pages, with common error
//! messages.
//!
//! Like the experiments and the workbench, this crate uses both the model and the simulated world.

pub mod design;
pub mod discriminate;
pub mod failure;
pub mod first_plan;
pub mod fit;
pub mod input;
pub mod memory;
pub mod session;
pub mod simulate;

pub use failure::{Exit, Failure};
