//! What is said of campaigns that are read with gauges, balls, levels or scales, and of sensors that are not what the file says.
//!
//! Machines, plans and effects are those of the calibration. In the first half each campaign is read in every way
//! ([`SensorSet`](hexbench_truth::campaign::SensorSet)), by the exact finite displacement of the points between the two states, with
//! sensors that stand where the file says to their tolerance; beside them campaigns whose first sensor is wrong
//! ([`SensorFault`](hexbench_truth::campaign::SensorFault)). In the second half one campaign is read in three ways that tell the same
//! ([`AlikeReadings`](hexbench_truth::campaign::AlikeReadings)), whole and with empty cells.

mod alike;
mod document;
mod information;
mod protocol;
mod record;
mod sheets;

pub use alike::{ALIKE, AlikeAnswer, AlikeProtocol, AlikeRecord, AlikeStudy};
pub use document::{headlines, page};
pub use information::SHOWN;
pub use protocol::{SEED, SensorProtocol, SensorStudy, TRIALS};
pub use record::SensorRecord;
pub use sheets::{alike, faults, shown, ways};
