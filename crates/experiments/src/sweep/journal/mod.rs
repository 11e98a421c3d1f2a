//! What of a study is done, on disk.
//!
//! ```text
//! DIR/journal/study.json      whose journal this is: digests of the study and its files, format, program
//! DIR/journal/lock            held by the run at work
//! DIR/journal/00000042.shard  one record per shard
//! ```
//!
//! A record is written beside its place and renamed, so that it is there whole or not at all, whenever the run is killed. It ends
//! with its SHA-256: one that was cut or changed later, by a copy between machines for example, is recognised and
//! computed again. Records are independent of each other: those of several machines may be put into one folder.

mod lock;
mod origin;
mod record;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use hexbench_core::files::atomic_write;
use rayon::prelude::*;

use crate::sweep::error::StudyError;
use crate::sweep::runner::Runner;
use crate::sweep::shard::Shard;
use lock::Lock;
pub use origin::FORMAT;
use origin::Origin;

/// Computes a shard and gives its record as a journal keeps it, for a journal elsewhere; it carries its own SHA-256.
pub fn record(runner: &Runner, number: u64) -> Vec<u8> {
    record::encode(&runner.run(number), Origin::of(runner.study()).digest())
}

/// The journal of a study, in use by this run alone.
pub struct Journal {
    folder: PathBuf,
    origin: Origin,
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
    /// Opens the journal of a study in a folder, which is made; an empty one begins.
    ///
    /// # Errors
    /// [`StudyError::Busy`], [`StudyError::Foreign`], [`StudyError::NotEmpty`], [`StudyError::Write`].
    pub fn open(folder: &Path, runner: &Runner) -> Result<Self, StudyError> {
        let own = folder.join("journal");
        refuse_other_content(folder, &own)?;
        fs::create_dir_all(&own).map_err(|cause| StudyError::Write { path: own.clone(), cause })?;
        let lock = Lock::take(folder, &own.join("lock"))?;
        let origin = Origin::of(runner.study());
        origin.settle(folder, &own.join("study.json"))?;
        remove_remains(&own).map_err(|cause| StudyError::Write { path: own.clone(), cause })?;
        Ok(Self { folder: folder.to_owned(), origin, _lock: lock })
    }

    /// Reads every record and tells which are missing.
    ///
    /// # Errors
    /// [`StudyError::Read`].
    pub fn state(&self, runner: &Runner) -> Result<State, StudyError> {
        let mut state = State::default();
        for number in 0..runner.shards() {
            match self.read(runner, number)? {
                Found::Whole(_) => {}
                Found::Damaged => {
                    state.damaged += 1;
                    state.pending.push(number);
                }
                Found::Missing => state.pending.push(number),
            }
        }
        Ok(state)
    }

    /// Computes shards on all threads and keeps each; `done` hears how many trials are done.
    ///
    /// # Errors
    /// [`StudyError::Write`]; what was kept before stays.
    pub fn compute(
        &self,
        runner: &Runner,
        pending: &[u64],
        done: &(dyn Fn(u64) + Sync),
    ) -> Result<(), StudyError> {
        pending.par_iter().try_for_each(|&number| {
            let shard = runner.run(number);
            self.keep(&shard)?;
            done(shard.trials.end - shard.trials.start);
            Ok(())
        })
    }

    /// Keeps a shard.
    ///
    /// # Errors
    /// [`StudyError::Write`]; the records before stay.
    pub fn keep(&self, shard: &Shard) -> Result<(), StudyError> {
        let path = self.place(shard.number);
        let bytes = self.encoded(shard);
        atomic_write(&path, |out| out.write_all(&bytes)).map_err(|cause| StudyError::Write { path, cause })
    }

    /// Takes over what another folder has done of the same study; what is there already is compared.
    ///
    /// # Errors
    /// [`StudyError::Foreign`] for the journal of another study, [`StudyError::Contradiction`] when two whole records of one shard
    /// differ, [`StudyError::Read`], [`StudyError::Write`].
    pub fn adopt(&self, runner: &Runner, folder: &Path) -> Result<Adopted, StudyError> {
        let journal = folder.join("journal");
        self.origin.check(folder, &journal.join("study.json"))?;
        let mut adopted = Adopted::default();
        for number in 0..runner.shards() {
            let shard = match self.read_at(&journal, runner, number)? {
                Found::Missing => continue,
                Found::Damaged => {
                    adopted.damaged += 1;
                    continue;
                }
                Found::Whole(shard) => shard,
            };
            match self.read(runner, number)? {
                // Compared as bytes: a number that is not one differs from itself.
                Found::Whole(own) if self.encoded(&own) == self.encoded(&shard) => adopted.known += 1,
                Found::Whole(_) => {
                    return Err(StudyError::Contradiction { folder: folder.to_owned(), shard: number });
                }
                _ => {
                    self.keep(&shard)?;
                    adopted.taken += 1;
                }
            }
        }
        Ok(adopted)
    }

    /// Keeps the record of a shard that was computed elsewhere ([`record`]); one that is here already is compared.
    ///
    /// # Errors
    /// [`StudyError::Garbled`] when it is not the whole record of this shard of this study, [`StudyError::Contradiction`],
    /// [`StudyError::Write`].
    pub fn keep_record(&self, runner: &Runner, number: u64, bytes: &[u8]) -> Result<(), StudyError> {
        let garbled = StudyError::Garbled { shard: number };
        if number >= runner.shards() {
            return Err(garbled);
        }
        let empty = Shard::empty(number, runner.trials_of(number), runner.columns());
        let shard = record::decode(bytes, empty, self.origin.digest()).ok_or(garbled)?;
        match self.read(runner, number)? {
            Found::Whole(own) if self.encoded(&own) == bytes => Ok(()),
            Found::Whole(_) => Err(StudyError::Contradiction { folder: self.folder.clone(), shard: number }),
            _ => self.keep(&shard),
        }
    }

    /// A shard that is done.
    ///
    /// # Errors
    /// [`StudyError::Missing`], [`StudyError::Read`].
    pub fn shard(&self, runner: &Runner, number: u64) -> Result<Shard, StudyError> {
        match self.read(runner, number)? {
            Found::Whole(shard) => Ok(shard),
            _ => Err(StudyError::Missing { folder: self.folder.clone(), shard: number }),
        }
    }

    /// Folder of the results.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn encoded(&self, shard: &Shard) -> Vec<u8> {
        record::encode(shard, self.origin.digest())
    }

    fn read(&self, runner: &Runner, number: u64) -> Result<Found, StudyError> {
        self.read_at(&self.folder.join("journal"), runner, number)
    }

    fn read_at(&self, journal: &Path, runner: &Runner, number: u64) -> Result<Found, StudyError> {
        let path = journal.join(record_name(number));
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => return Ok(Found::Missing),
            Err(cause) => return Err(StudyError::Read { path, cause }),
        };
        let empty = Shard::empty(number, runner.trials_of(number), runner.columns());
        Ok(record::decode(&bytes, empty, self.origin.digest()).map_or(Found::Damaged, Found::Whole))
    }

    fn place(&self, number: u64) -> PathBuf {
        self.folder.join("journal").join(record_name(number))
    }
}

fn record_name(number: u64) -> String {
    format!("{number:08}.shard")
}

enum Found {
    Whole(Shard),
    Damaged,
    Missing,
}

/// A folder without journal must be empty.
fn refuse_other_content(folder: &Path, journal: &Path) -> Result<(), StudyError> {
    if journal.exists() {
        return Ok(());
    }
    match fs::read_dir(folder).map(|mut entries| entries.next().is_some()) {
        Ok(true) => Err(StudyError::NotEmpty(folder.to_owned())),
        Ok(false) => Ok(()),
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(cause) => Err(StudyError::Write { path: folder.to_owned(), cause }),
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
