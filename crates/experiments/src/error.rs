//! Why an experiment stopped.

use std::io;
use std::path::{Path, PathBuf};

/// An experiment that cannot go on. What is in its journal stays there.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// It was told to stop.
    #[error("stopped")]
    Stopped,
    /// A record that has no form as bytes.
    #[error("a trial cannot be saved: {0}")]
    Unkept(String),
    /// The folder holds something else.
    #[error("{}: the folder is not empty and contains no {experiment}", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
        /// What was looked for.
        experiment: &'static str,
    },
    /// Another run works in the folder.
    #[error("{}: another run is using this folder{}", folder.display(), holder.map(|pid| format!(" (process {pid})")).unwrap_or_default())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Number of the process, when it is known.
        holder: Option<u32>,
    },
    /// The journal belongs to another experiment, or to another state of it.
    #[error("{}: {what}", folder.display())]
    Foreign {
        /// The folder.
        folder: PathBuf,
        /// What does not fit.
        what: String,
    },
    /// The journal cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A result or a record cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A shard that the results need is not in the journal.
    #[error("{}: shard {shard} is missing or damaged", folder.display())]
    Missing {
        /// The folder.
        folder: PathBuf,
        /// Number of the shard.
        shard: u64,
    },
    /// Two folders say different things of one shard.
    #[error("{}: shard {shard} is complete in both folders, but with different contents", folder.display())]
    Contradiction {
        /// The folder that was to be taken over.
        folder: PathBuf,
        /// Number of the shard.
        shard: u64,
    },
    /// A record that came from elsewhere is not what it should be.
    #[error(
        "the data received for shard {shard} are invalid: truncated, changed, or from another study or version"
    )]
    Garbled {
        /// Number of the shard.
        shard: u64,
    },
    /// Shards are missing after all parts were put together.
    #[error("{missing} of {all} shards are missing in the folders, the first is shard {first}")]
    Incomplete {
        /// How many.
        missing: u64,
        /// The smallest of them.
        first: u64,
        /// All shards of the experiment.
        all: u64,
    },
}

impl ExperimentError {
    /// What to do next, one sentence.
    pub fn next_step(&self) -> String {
        match self {
            Self::NotEmpty { .. } => "Name another folder.",
            Self::Busy { .. } => "Wait for it to end, or name another folder.",
            Self::Foreign { .. } => {
                "Name another folder, or use the study and the program version with which this one was begun."
            }
            Self::Read { .. } => "Check that the file may be read.",
            Self::Write { .. } => {
                "Check the free space and that the folder may be written to, then run the same command again; it resumes where \
                 it stopped."
            }
            Self::Stopped => "Run the same command again; it resumes where it stopped.",
            Self::Unkept(_) => "Omit --journal.",
            Self::Missing { .. } => "Run the same command again; it recomputes the shard.",
            Self::Contradiction { .. } => {
                "The same program on the same files gives the same bytes. Find out which folder comes from another machine \
                 or build, and omit it."
            }
            Self::Garbled { .. } => {
                "Make sure that every worker has the same version of hexbench and reads the same files."
            }
            Self::Incomplete { .. } => {
                "Name the folder of every part; to finish a part that was stopped, run its command again."
            }
        }
        .into()
    }

    /// True when the trouble is with the disk rather than with what a file says.
    pub fn is_input_output(&self) -> bool {
        matches!(self, Self::Busy { .. } | Self::Read { .. } | Self::Write { .. } | Self::Missing { .. })
    }

    pub(crate) fn reading(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |cause| Self::Read { path, cause }
    }

    pub(crate) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |cause| Self::Write { path, cause }
    }
}
