//! What laboratories that do not keep to the assumptions get.
//!
//! Calibration asks for probabilities under the model's own assumptions: exact geometry and loads, independent noise of exactly the
//! stated size. Here one of them is broken at a time ([`hexbench_truth::laboratory`]): the same machines, plans, effects and noise go
//! through the diagnosis with every fault, and what is said of machine and data is held against what was done to them.

mod document;
mod findings;
mod mistakes;
mod protocol;
mod record;
pub mod sheets;
mod study;
mod violation;

pub use document::{headlines, page};
pub use findings::{Detection, detections};
pub use mistakes::{FaultMistakes, mistakes};
pub(crate) use protocol::Job;
pub use protocol::{DISTANCE, RobustnessProtocol, SEED, TRIALS};
pub use record::RobustnessRecord;
pub(crate) use study::fields;
pub use study::{Robustness, case};
pub use violation::Violation;
