//! Why the gate cannot go on.

use std::path::PathBuf;

use thiserror::Error;

use crate::alarm::BaselineFileError;
use crate::challenge::ChallengeError;

/// The command that makes a baseline.
pub const RECORD: &str = "hexbench gate record SUITE -- PROGRAM";

/// Why the gate cannot go on. What a program does wrong is never one of these: that is a result.
#[derive(Debug, Error)]
pub enum GateError {
    /// The challenge cannot be made, run or scored.
    #[error(transparent)]
    Challenge(#[from] ChallengeError),
    /// The baseline cannot be read or written.
    #[error(transparent)]
    File(#[from] BaselineFileError),
    /// A baseline whose numbers contradict each other.
    #[error("{}: {fault}", path.display())]
    Impossible {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: String,
    },
    /// Other cases than those of the baseline.
    #[error("the cases differ from those of the baseline: {ours} instead of {theirs}")]
    OtherCases {
        /// Digest of the baseline's cases.
        theirs: String,
        /// Digest of these.
        ours: String,
    },
    /// A challenge that only its folder holds.
    #[error("the baseline was recorded on an existing challenge, whose folder is missing")]
    NeedsFolder,
    /// A program that only another process has.
    #[error("the baseline belongs to a Python function ({0}), which the command line cannot call")]
    NeedsFunction(String),
    /// A seed for cases that are made already.
    #[error("{}: these cases exist already and have their seed", .0.display())]
    SeedOfMadeCases(PathBuf),
    /// A program that answers none of its cases: a baseline of that would accept everything.
    #[error("the program answered no case; of the first: {0}")]
    NothingAnswered(String),
    /// A part that this program has not answered.
    #[error("{}: there are no answers of this program in this folder", .0.display())]
    NoPart(PathBuf),
    /// The folder of a part as that of the work, where its answers would be replaced.
    #[error("{}: this is the folder of --work too", .0.display())]
    PartIsWork(PathBuf),
}

impl GateError {
    /// What to do about it, one sentence.
    pub fn next_step(&self) -> String {
        match self {
            Self::Challenge(error) => error.next_step(),
            Self::File(error) => error.next_step(RECORD),
            Self::Impossible { .. } => format!("Restore the file from version control, or make a new one with `{RECORD}`."),
            Self::OtherCases { .. } => {
                "Another version of hexbench generates different cases: record the baseline again with `hexbench gate record`, or use the version that it names."
                    .to_owned()
            }
            Self::NeedsFolder => "Add --challenge DIR, with its sealed part.".to_owned(),
            Self::NeedsFunction(_) => {
                "Check it with hexbench.gate_check(BASELINE, function) in Python, or name a program after --.".to_owned()
            }
            Self::NothingAnswered(_) => {
                "Repair the program or its command line; `--work DIR` keeps what it wrote and printed.".to_owned()
            }
            Self::NoPart(_) => {
                "Name the folders that were the --work of the parts; a part of the program before an edit is answered again.".to_owned()
            }
            Self::PartIsWork(_) => "Give --work another folder, or omit it.".to_owned(),
            Self::SeedOfMadeCases(_) => "Omit --seed, or name a suite instead of a folder.".to_owned(),
        }
    }
}
