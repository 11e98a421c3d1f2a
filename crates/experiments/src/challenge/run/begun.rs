//! Whose answers a folder holds: `answers.json`.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Entrant, Program, ProgramFiles, RunLimits};
use crate::challenge::folder::refuse_content;
use crate::challenge::make::write;
use crate::challenge::stored::{Stored, json, read_json};
use crate::challenge::{Challenge, ChallengeError};
use crate::error::ExperimentError;
use crate::journal::{Lock, Locked};

/// Name of the file.
pub const ANSWERS: &str = "answers.json";
/// Name of the folder of the answered cases.
const CASES: &str = "cases";
/// Held by the run at work.
const LOCK: &str = ".lock";

/// Who answered, how it was called, which challenge, under which limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunHeader {
    /// `answers/1`.
    pub format: String,
    /// Name of the entrant.
    pub name: String,
    /// Program and arguments, without the two folders.
    pub program: Vec<String>,
    /// What the program is made of, as it was when the answers were given.
    #[serde(default)]
    pub files: ProgramFiles,
    /// Suite of the challenge.
    pub suite: String,
    /// Version of the suite.
    pub version: u64,
    /// SHA-256 of `challenge.toml`.
    pub challenge_sha256: String,
    /// Limits of each case.
    pub limits: RunLimits,
    /// System and processor.
    pub system: String,
}

impl Stored for RunHeader {
    const FORMAT: &'static str = "answers/1";

    fn format(&self) -> &str {
        &self.format
    }
}

impl RunHeader {
    pub(super) fn new(challenge: &Challenge, entrant: &Entrant) -> Result<Self, ChallengeError> {
        Ok(Self {
            format: Self::FORMAT.to_owned(),
            name: entrant.name.clone(),
            program: entrant.program.line().to_vec(),
            files: ProgramFiles::of(&entrant.program)?,
            suite: challenge.manifest().suite.clone(),
            version: challenge.manifest().version,
            challenge_sha256: challenge.sha256().to_owned(),
            limits: entrant.limits,
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        })
    }

    /// Reads `answers.json` of a folder.
    ///
    /// # Errors
    /// [`ExperimentError::Read`], [`ChallengeError::Malformed`].
    pub fn read(folder: &Path) -> Result<Self, ChallengeError> {
        read_json(&folder.join(ANSWERS))
    }

    /// Refuses answers to another challenge.
    ///
    /// # Errors
    /// [`ChallengeError::OtherChallenge`].
    pub(crate) fn check(&self, folder: &Path, challenge: &Challenge) -> Result<(), ChallengeError> {
        self.refuse_unless(folder, challenge.sha256(), challenge.name())
    }

    fn refuse_unless(&self, folder: &Path, sha256: &str, ours: String) -> Result<(), ChallengeError> {
        if self.challenge_sha256 == sha256 {
            return Ok(());
        }
        Err(ChallengeError::OtherChallenge { folder: folder.to_owned(), theirs: self.challenge(), ours })
    }

    /// Suite, version and digest of the challenge, for messages.
    fn challenge(&self) -> String {
        format!("{} version {}, {:.12}", self.suite, self.version, self.challenge_sha256)
    }

    /// Makes a folder that of this run: empty, or with answers of the same run that go on.
    pub(super) fn settle(&self, folder: &Path, again: bool) -> Result<Lock, ChallengeError> {
        let (path, cases) = (folder.join(ANSWERS), cases_folder(folder));
        let is_known = path.exists();
        if !is_known {
            // Nothing of a folder that is not ours is touched, the challenge itself for example.
            refuse_content(folder, &[LOCK])?;
        }
        fs::create_dir_all(folder).map_err(ExperimentError::writing(folder))?;
        let lock = Lock::take(&folder.join(LOCK)).map_err(|locked| match locked {
            Locked::By(_) => ChallengeError::Busy(folder.to_owned()),
            Locked::Not(path, cause) => ExperimentError::Write { path, cause }.into(),
        })?;
        if is_known && !again {
            self.refuse_others(folder)?;
        } else {
            write(&path, &json(self))?;
            if cases.exists() {
                fs::remove_dir_all(&cases).map_err(ExperimentError::writing(&cases))?;
            }
        }
        fs::create_dir_all(&cases).map_err(ExperimentError::writing(&cases))?;
        Ok(lock)
    }

    /// Refuses the answers of another run.
    pub(super) fn refuse_others(&self, folder: &Path) -> Result<(), ChallengeError> {
        let there = Self::read(folder)?;
        there.refuse_unless(folder, &self.challenge_sha256, self.challenge())?;
        let what = if there.program != self.program {
            format!("there the program is {}", there.program.join(" "))
        } else if let Some(change) = there.files.changes(&self.files).first() {
            format!("since then {change}")
        } else if there.name != self.name {
            format!("there the name is {}", there.name)
        } else if there.limits != self.limits {
            let RunLimits { time_s, memory_mb, output_mb } = there.limits;
            format!("there the limits are {time_s} s, {memory_mb} MB of memory, {output_mb} MB of output")
        } else {
            return Ok(());
        };
        Err(ChallengeError::OtherProgram { folder: folder.to_owned(), what })
    }

    /// Refuses answers of which nobody knows whether they are of the program before an edit or after it.
    pub(super) fn refuse_edits(&self, folder: &Path, program: &Program) -> Result<(), ChallengeError> {
        let now = ProgramFiles::of(program)?;
        match self.files.changes(&now).first() {
            Some(change) => {
                let what = format!("while the program ran {change}");
                Err(ChallengeError::OtherProgram { folder: folder.to_owned(), what })
            }
            None => Ok(()),
        }
    }
}

/// Folder of the answered cases.
pub(crate) fn cases_folder(answers: &Path) -> PathBuf {
    answers.join(CASES)
}
