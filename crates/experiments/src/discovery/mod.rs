//! Whether laws that no catalogue lists are found, and only where there are any.
//!
//! Campaigns with effects outside the catalogue, with effects of the catalogue and on clean machines go through
//! [`discover`](hexbench_model::results::discover::discover). The effects are those of the simulated world, which knows nothing of the
//! grammar of laws: some are products of its building blocks, some no formula of it can say.

mod document;
mod fate;
mod protocol;
mod record;
mod sheets;

pub use document::{DiscoveryTrials, headlines, page};
pub use fate::LawFate;
pub use protocol::{DISTANCES, DiscoveryProtocol, SEED};
pub use record::DiscoveryRecord;
