//! Diagnosis of campaigns read with gauges, balls, levels or scales, and with sensors that differ from the file.
//!
//! Machines, plans and effects are those of the calibration. In the first half each campaign is read in every way
//! ([`SensorSet`](hexbench_truth::campaign::SensorSet)), by the exact finite displacement of the points between the two states, with
//! sensors at the stated positions to within their tolerance; further campaigns have a wrong first sensor
//! ([`SensorFault`](hexbench_truth::campaign::SensorFault)). In the second half one campaign is read in three equivalent ways
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
pub use protocol::{SEED, SensorJob, SensorProtocol, SensorStudy, TRIALS};
pub use record::SensorRecord;
pub use sheets::{alike, faults, shown, ways};
