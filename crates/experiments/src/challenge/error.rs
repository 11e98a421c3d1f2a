//! Why a challenge cannot be made, run or scored.

use std::io;
use std::path::PathBuf;

use hexbench_core::files::FileError;
use hexbench_truth::TruthError;
use thiserror::Error;

use crate::error::ExperimentError;

/// Why a challenge cannot go on. What a program under test does wrong is never one of these: that is a result.
#[derive(Debug, Error)]
pub enum ChallengeError {
    /// A file that cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// No suite of this name, and no such file.
    #[error("there is no suite \"{name}\", neither bundled nor as a file")]
    NoSuite {
        /// As written.
        name: String,
        /// Names of the bundled ones.
        known: Vec<&'static str>,
    },
    /// A hidden seed that can be tried out.
    #[error("a hidden seed of {found} characters can be guessed; it needs at least {least}")]
    ShortSeed {
        /// Characters of its text.
        found: usize,
        /// Characters it needs.
        least: usize,
    },
    /// A case that no draw made visible.
    #[error("case {number} of [cases.{group}] cannot be simulated: {cause}")]
    Case {
        /// Table of the suite.
        group: String,
        /// Number within it, from 1.
        number: usize,
        /// Why.
        cause: TruthError,
    },
    /// A folder that holds something else.
    #[error("{} is not empty", .0.display())]
    NotEmpty(PathBuf),
    /// A file whose content is not what this program writes.
    #[error("{}: {why}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        why: String,
    },
    /// A file that changed after the challenge was made.
    #[error("{}: {found}; its SHA-256 was {expected}", path.display())]
    Tampered {
        /// The file.
        path: PathBuf,
        /// What is there instead.
        found: String,
        /// Digest when it was made.
        expected: String,
    },
    /// Answers to another challenge.
    #[error("{}: these answers belong to another challenge (suite {theirs}, not {ours})", folder.display())]
    OtherChallenge {
        /// Folder of the answers.
        folder: PathBuf,
        /// Suite, version and digest there.
        theirs: String,
        /// Suite, version and digest here.
        ours: String,
    },
    /// Answers of another program, or under other limits.
    #[error("{}: these answers belong to another run: {what}", folder.display())]
    OtherProgram {
        /// Folder of the answers.
        folder: PathBuf,
        /// What differs.
        what: String,
    },
    /// A program that is not there.
    #[error("there is no program \"{0}\"")]
    NoProgram(String),
    /// A file that is there and cannot be run by itself.
    #[error("\"{}\" is not executable", .0.display())]
    NotExecutable(PathBuf),
    /// A file or folder that a program is said to depend on, which is not there.
    #[error("--depends {}: there is no such file or folder", .0.display())]
    NoDependency(PathBuf),
    /// A folder that is more than a program.
    #[error("--depends {}: it contains more than {most} files", folder.display())]
    TooManyFiles {
        /// The folder.
        folder: PathBuf,
        /// How many are taken.
        most: usize,
    },
    /// Another run is at work.
    #[error("{} is in use by another run", .0.display())]
    Busy(PathBuf),
    /// It was told to stop, or a file cannot be read or written.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// Two entrants of one name.
    #[error("two of the folders contain answers named \"{0}\"")]
    SameName(String),
    /// Cases without an answer after all parts were put together.
    #[error("{missing} of {all} cases are missing in the folders, the first is {first}")]
    Unanswered {
        /// How many.
        missing: usize,
        /// Id of the first of them.
        first: String,
        /// All cases.
        all: usize,
    },
    /// A program that could not be started or watched.
    #[error("case {case}: the program could not be started or watched: {cause}")]
    Start {
        /// Its case.
        case: String,
        /// Why.
        cause: io::Error,
    },
}

impl ChallengeError {
    /// What to do about it, one sentence.
    pub fn next_step(&self) -> String {
        match self {
            Self::File(error) => error.next_step(),
            Self::NoSuite { known, .. } => {
                format!("Use {}, or the path of a suite file.", known.join(", "))
            }
            Self::ShortSeed { .. } => {
                "Fill the file with random characters, for example: openssl rand -hex 32 > seed.txt".into()
            }
            Self::Case { .. } => {
                "Use a larger distance, another plan or another effect; this one is not visible.".into()
            }
            Self::NotEmpty(_) => "Name another folder, or empty this one.".into(),
            Self::Malformed { .. } => "Restore the file, or make it again with the same command.".into(),
            Self::Tampered { .. } => {
                "Restore the file, or make the challenge again; the same suite and seed give the same bytes."
                    .into()
            }
            Self::OtherChallenge { .. } => {
                "Use the challenge for which they were made, or run the program again.".into()
            }
            Self::OtherProgram { .. } => "Name another folder, or add --again to replace them.".into(),
            Self::NoProgram(_) => "Name a path, or a program on the PATH.".into(),
            Self::NotExecutable(path) => format!(
                "Begin with the program that reads it, for example: -- python3 {0} (or sh {0}); or make it executable: chmod +x {0}",
                path.display()
            ),
            Self::NoDependency(_) => "Name a file or folder that the program reads or imports.".into(),
            Self::TooManyFiles { .. } => {
                "Name only the folders of the program, each with its own --depends.".into()
            }
            Self::Busy(_) => "Wait for it to end, or name another folder.".into(),
            Self::Experiment(error) => error.next_step(),
            Self::SameName(_) => "Run one of them again with another --name.".into(),
            Self::Unanswered { .. } => {
                "Name the folder of every part; to finish a part that was stopped, run its command again."
                    .into()
            }
            Self::Start { .. } => {
                "Check that sh is installed, and that the folder for temporary files has free space.".into()
            }
        }
    }

    /// True when the trouble is with the disk rather than with what a file says.
    pub fn is_input_output(&self) -> bool {
        match self {
            Self::File(error) => error.is_input_output(),
            Self::Experiment(error) => error.is_input_output(),
            Self::Busy(_) | Self::Start { .. } => true,
            _ => false,
        }
    }
}
