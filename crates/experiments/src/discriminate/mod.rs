//! Tests whether the proposed readings lead to the right answer: effects that a plan confuses are diagnosed, the proposed
//! readings are taken on the same simulated machine, and everything is diagnosed again; the same number of random readings
//! serves as comparison.

mod bench;
mod confusion;
mod document;
pub mod sheets;
mod study;
mod trial;

pub use bench::MeasuredMachine;
pub use confusion::{CONFUSIONS, ConfusedPair};
pub use document::{headlines, page};
pub use study::{DiscriminateProtocol, Discrimination, PairTrials, SEED};
pub use trial::{DiscriminateRecord, READINGS};
