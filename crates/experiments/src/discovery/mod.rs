//! Tests whether laws outside the catalogue are found if and only if they are present.
//!
//! Campaigns with effects outside the catalogue, with effects of the catalogue and on clean machines go through
//! [`discover`](hexbench_model::results::discover::discover). The effects are those of the simulated world, which does not know the
//! grammar of laws: some are products of its building blocks, others cannot be expressed by its formulas.

mod document;
mod fate;
mod protocol;
mod record;
mod sheets;

pub use document::{DiscoveryTrials, headlines, page};
pub use fate::LawFate;
pub use protocol::{DISTANCES, DiscoveryProtocol, SEED};
pub use record::DiscoveryRecord;
