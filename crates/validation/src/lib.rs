//! The proving ground: simulated campaigns with a known truth go through the identification, and what it says is compared
//! with what was hidden.
//!
//! Next to the command this is the only place that sees both worlds. It holds no physics of its own: campaigns come from
//! `hexbench_truth`, answers from `hexbench_model`.

pub mod calibration;
pub mod discriminate;
pub mod paper;
pub mod power;
pub mod proportion;
pub mod recovery;
pub mod regress;
pub mod trial;

pub use proportion::Proportion;
pub use trial::{Outcome, Trial, TrialError};
