//! The finished part of an experiment, on disk.
//!
//! ```text
//! DIR/journal/NAME.json       whose journal this is: what its trials depend on, format, program
//! DIR/journal/lock            held by the run at work
//! DIR/journal/00000042.shard  the results of some consecutive trials, where there are at most 512 of these records
//! DIR/journal/000000.records  many of them, where there are more
//! ```
//!
//! A record is written to a temporary name and renamed, or appended to a volume, so that it is complete or absent whenever the run is killed. It ends with
//! its SHA-256: a record truncated or changed later, for example by copying between machines, is recognized and computed again. Records are independent:
//! those of several machines may be put into one folder.

mod lock;
mod origin;
mod record;
mod records;
mod shards;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::error::ExperimentError;
pub(crate) use lock::{Lock, Locked};
pub use origin::Identity;
use origin::Origin;
use records::Records;
pub use shards::Shards;

/// The record of a shard that was computed for a journal elsewhere; it carries its own SHA-256.
pub fn record(identity: Identity, shards: Shards, number: u64, content: &[u8]) -> Vec<u8> {
    record::encode(&head(&Origin::of(identity), shards, number), content)
}

/// The journal of an experiment, in use by this run alone.
pub struct Journal {
    folder: PathBuf,
    origin: Origin,
    shards: Shards,
    records: Records,
    _lock: Lock,
}

/// What is in a journal.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct State {
    /// Shards still to be computed, in order.
    pub pending: Vec<u64>,
    /// Records that were cut or changed, among the pending ones.
    pub damaged: u64,
}

/// What came from another folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Adopted {
    /// Shards that were missing here.
    pub taken: u64,
    /// Shards that were here already, with the same bytes.
    pub known: u64,
    /// Records that were cut or changed, left where they are.
    pub damaged: u64,
}

impl Journal {
    /// Opens the journal of an experiment in a folder, which is made; an empty one begins.
    ///
    /// # Errors
    /// [`ExperimentError::Busy`], [`ExperimentError::Foreign`], [`ExperimentError::NotEmpty`], [`ExperimentError::Write`].
    pub fn open(folder: &Path, identity: Identity, shards: Shards) -> Result<Self, ExperimentError> {
        let own = folder.join("journal");
        refuse_other_content(folder, &own, identity.name)?;
        fs::create_dir_all(&own).map_err(ExperimentError::writing(&own))?;
        let lock = Lock::take(&own.join("lock")).map_err(|locked| locked.of(folder))?;
        let origin = Origin::of(identity);
        origin.settle(folder, &own)?;
        remove_remains(&own).map_err(ExperimentError::writing(&own))?;
        let records = Records::open(&own, shards.count()).map_err(ExperimentError::reading(&own))?;
        Ok(Self { folder: folder.to_owned(), origin, shards, records, _lock: lock })
    }

    /// Reads every record and tells which are missing.
    ///
    /// # Errors
    /// [`ExperimentError::Read`].
    pub fn state(&self) -> Result<State, ExperimentError> {
        let mut state = State::default();
        for number in 0..self.shards.count() {
            match self.found(&self.records, number)? {
                Found::Whole(_) => continue,
                Found::Damaged => state.damaged += 1,
                Found::Missing => {}
            }
            state.pending.push(number);
        }
        Ok(state)
    }

    /// Keeps what a shard holds.
    ///
    /// # Errors
    /// [`ExperimentError::Write`]; the records before stay.
    pub fn keep(&self, number: u64, content: &[u8]) -> Result<(), ExperimentError> {
        self.put(number, &record::encode(&self.head(number), content))
    }

    /// Takes over what another folder has done of the same experiment; what is there already is compared.
    ///
    /// # Errors
    /// [`ExperimentError::Foreign`] for the journal of another experiment, [`ExperimentError::Contradiction`] when two whole
    /// records of one shard differ, [`ExperimentError::Read`], [`ExperimentError::Write`].
    pub fn adopt(&self, folder: &Path) -> Result<Adopted, ExperimentError> {
        let journal = folder.join("journal");
        self.origin.check(folder, &journal)?;
        let theirs =
            Records::open(&journal, self.shards.count()).map_err(ExperimentError::reading(&journal))?;
        let mut adopted = Adopted::default();
        for number in 0..self.shards.count() {
            match self.found(&theirs, number)? {
                Found::Missing => {}
                Found::Damaged => adopted.damaged += 1,
                Found::Whole(bytes) if self.take(folder, number, &bytes)? => adopted.taken += 1,
                Found::Whole(_) => adopted.known += 1,
            }
        }
        Ok(adopted)
    }

    /// Keeps the record of a shard that was computed elsewhere ([`record()`]); one that is here already is compared.
    ///
    /// # Errors
    /// [`ExperimentError::Garbled`] when it is not the whole record of this shard of this experiment,
    /// [`ExperimentError::Contradiction`], [`ExperimentError::Write`].
    pub fn keep_record(&self, number: u64, bytes: &[u8]) -> Result<(), ExperimentError> {
        if number >= self.shards.count() || record::decode(bytes, &self.head(number)).is_none() {
            return Err(ExperimentError::Garbled { shard: number });
        }
        self.take(&self.folder, number, bytes).map(drop)
    }

    /// What a shard that is done holds.
    ///
    /// # Errors
    /// [`ExperimentError::Missing`], [`ExperimentError::Read`].
    pub fn content(&self, number: u64) -> Result<Vec<u8>, ExperimentError> {
        if let Found::Whole(bytes) = self.found(&self.records, number)?
            && let Some(content) = record::decode(&bytes, &self.head(number))
        {
            return Ok(content.to_vec());
        }
        Err(self.missing(number))
    }

    /// A shard that the results need and that is not there.
    pub fn missing(&self, number: u64) -> ExperimentError {
        ExperimentError::Missing { folder: self.folder.clone(), shard: number }
    }

    /// Folder of the results.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// How the trials are divided.
    pub fn shards(&self) -> Shards {
        self.shards
    }

    /// Keeps a whole record from elsewhere; false when it was here already.
    fn take(&self, from: &Path, number: u64, bytes: &[u8]) -> Result<bool, ExperimentError> {
        match self.found(&self.records, number)? {
            Found::Whole(own) if own == bytes => Ok(false),
            Found::Whole(_) => Err(ExperimentError::Contradiction { folder: from.to_owned(), shard: number }),
            _ => self.put(number, bytes).map(|()| true),
        }
    }

    fn put(&self, number: u64, bytes: &[u8]) -> Result<(), ExperimentError> {
        self.records.put(number, bytes).map_err(|(path, cause)| ExperimentError::Write { path, cause })
    }

    fn found(&self, records: &Records, number: u64) -> Result<Found, ExperimentError> {
        let known = records.get(number).map_err(|(path, cause)| ExperimentError::Read { path, cause })?;
        Ok(match known {
            None => Found::Missing,
            Some(bytes) if record::decode(&bytes, &self.head(number)).is_some() => Found::Whole(bytes),
            Some(bytes) if record::is_of_fewer_trials(&bytes, &self.head(number)) => Found::Missing,
            Some(_) => Found::Damaged,
        })
    }

    fn head(&self, number: u64) -> Vec<u8> {
        head(&self.origin, self.shards, number)
    }
}

fn head(origin: &Origin, shards: Shards, number: u64) -> Vec<u8> {
    record::head(origin.digest(), number, &shards.trials_of(number))
}

enum Found {
    /// With the bytes of the record.
    Whole(Vec<u8>),
    Damaged,
    Missing,
}

/// A folder without journal must be empty.
fn refuse_other_content(
    folder: &Path,
    journal: &Path,
    experiment: &'static str,
) -> Result<(), ExperimentError> {
    // One look: another run may be about to make the journal.
    let paths = |entries: fs::ReadDir| entries.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>();
    match fs::read_dir(folder).and_then(paths) {
        Ok(paths) if paths.is_empty() || paths.iter().any(|path| path == journal) => Ok(()),
        Ok(_) => Err(ExperimentError::NotEmpty { folder: folder.to_owned(), experiment }),
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(cause) => Err(ExperimentError::writing(folder)(cause)),
    }
}

/// Removes what a killed run was about to write.
fn remove_remains(journal: &Path) -> io::Result<()> {
    for entry in fs::read_dir(journal)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "part") {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}
