//! Work that a journal keeps in shards.

use super::{Progress, each};
use crate::error::ExperimentError;
use crate::journal::{self, Identity, Journal, Shards};

/// An experiment whose trials are computed and kept shard by shard.
pub trait Sharded: Sync {
    /// Everything the trials depend on.
    fn identity(&self) -> Identity;

    /// How its trials are divided.
    fn shards(&self) -> Shards;

    /// The results of a shard as bytes, the same for the same identity and number; `progress` hears of its trials.
    ///
    /// # Errors
    /// [`ExperimentError::Stopped`].
    fn content(&self, shard: u64, progress: &dyn Progress) -> Result<Vec<u8>, ExperimentError>;
}

/// Computes shards on all threads and keeps each in a journal.
///
/// # Errors
/// [`ExperimentError::Write`], [`ExperimentError::Stopped`]; what was kept before stays.
pub fn compute(
    journal: &Journal,
    work: &dyn Sharded,
    pending: &[u64],
    progress: &dyn Progress,
) -> Result<(), ExperimentError> {
    let keep = |shard| journal.keep(shard, &work.content(shard, progress)?);
    each(pending.to_vec(), progress, keep).map(|_: Vec<()>| ())
}

/// Computes a shard and gives its record as a journal keeps it, for a journal elsewhere.
///
/// # Errors
/// As [`Sharded::content`].
pub fn record(work: &dyn Sharded, shard: u64) -> Result<Vec<u8>, ExperimentError> {
    let content = work.content(shard, &super::Silent)?;
    Ok(journal::record(work.identity(), work.shards(), shard, &content))
}
