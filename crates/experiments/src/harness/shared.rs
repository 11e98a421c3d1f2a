//! An experiment shared among processes and machines: each computes a part into a journal of its own, one takes over all of them.

use std::path::{Path, PathBuf};

use super::{ExperimentPart, Progress, Sharded, compute};
use crate::error::ExperimentError;
use crate::journal::{Adopted, Journal, Shards};

/// Computes what is missing of a part, or of the whole, and keeps it in the journal of a folder.
///
/// # Errors
/// As [`Journal::open`] and [`compute`].
pub fn compute_part(
    work: &dyn Sharded,
    folder: &Path,
    part: Option<ExperimentPart>,
    progress: &dyn Progress,
) -> Result<Journal, ExperimentError> {
    let shards = work.shards();
    let journal = Journal::open(folder, work.identity(), shards)?;
    let state = journal.state()?;
    let own = |shard: &u64| part.is_none_or(|part| part.holds(*shard));
    let all: Vec<u64> = (0..shards.count()).filter(own).collect();
    let pending: Vec<u64> = state.pending.into_iter().filter(own).collect();
    let trials = shards.trials_in(&all);
    progress.damaged(state.damaged);
    progress.begin(trials, trials - shards.trials_in(&pending));
    compute(&journal, work, &pending, progress)?;
    Ok(journal)
}

/// Takes over what the journals of other folders have done, and refuses to go on when trials are missing; `took` hears of each folder.
///
/// # Errors
/// As [`Journal::open`] and [`Journal::adopt`]; [`ExperimentError::Incomplete`].
pub fn take_over(
    work: &dyn Sharded,
    folder: &Path,
    parts: &[PathBuf],
    took: &dyn Fn(&Path, Adopted),
) -> Result<(), ExperimentError> {
    let journal = Journal::open(folder, work.identity(), work.shards())?;
    for part in parts {
        took(part, journal.adopt(part)?);
    }
    refuse_pending(&journal.state()?.pending, work.shards())
}

/// Refuses to go on while shards are pending.
///
/// # Errors
/// [`ExperimentError::Incomplete`].
pub(crate) fn refuse_pending(pending: &[u64], shards: Shards) -> Result<(), ExperimentError> {
    pending.first().map_or(Ok(()), |&first| {
        let missing = pending.len() as u64;
        Err(ExperimentError::Incomplete { missing, first, all: shards.count() })
    })
}
