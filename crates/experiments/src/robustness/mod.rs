//! Robustness: what happens if a laboratory violates the assumptions.
//!
//! Calibration tests probabilities under the model's own assumptions: exact geometry and loads, independent noise of exactly the
//! stated size. Here one assumption is violated at a time ([`hexbench_truth::laboratory`]): the same machines, plans, effects and
//! noise are diagnosed with every fault, and the statements about machine and data are compared with the truth.

mod document;
mod findings;
mod protocol;
mod record;
pub mod sheets;
mod violation;

pub use document::{headlines, page};
pub use findings::{Detection, detections};
pub use protocol::{DISTANCE, Robustness, RobustnessJob, RobustnessProtocol, SEED, TRIALS, case};
pub(crate) use protocol::{distances, fields};
pub use record::RobustnessRecord;
pub use violation::Violation;
