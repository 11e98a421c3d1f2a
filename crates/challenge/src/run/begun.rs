//! Whose answers a folder holds: `answers.json`.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Entrant, Limits};
use crate::make::write;
use crate::{Challenge, ChallengeError};

/// Name of the file.
pub const ANSWERS: &str = "answers.json";
/// Name of the folder of the answered cases.
const CASES: &str = "cases";
/// Held by the run at work.
const LOCK: &str = ".lock";
/// Name and version of the format.
const FORMAT: &str = "answers/1";

/// Who answered, how it was called, which challenge, under which limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Begun {
    /// `answers/1`.
    pub format: String,
    /// Name of the entrant.
    pub name: String,
    /// Program and arguments, without the two folders.
    pub program: Vec<String>,
    /// Suite of the challenge.
    pub suite: String,
    /// Version of the suite.
    pub version: u64,
    /// SHA-256 of `challenge.toml`.
    pub challenge_sha256: String,
    /// Limits of each case.
    pub limits: Limits,
    /// System and processor.
    pub system: String,
}

impl Begun {
    pub(super) fn new(challenge: &Challenge, entrant: &Entrant) -> Self {
        Self {
            format: FORMAT.to_owned(),
            name: entrant.name.clone(),
            program: entrant.program.line().to_vec(),
            suite: challenge.manifest().suite.clone(),
            version: challenge.manifest().version,
            challenge_sha256: challenge.sha256().to_owned(),
            limits: entrant.limits,
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        }
    }

    /// Reads `answers.json` of a folder.
    ///
    /// # Errors
    /// [`ChallengeError::Read`], [`ChallengeError::Malformed`].
    pub fn read(folder: &Path) -> Result<Self, ChallengeError> {
        let path = folder.join(ANSWERS);
        let text = fs::read_to_string(&path).map_err(ChallengeError::reading(&path))?;
        let malformed = |why: String| ChallengeError::Malformed { path: path.clone(), why };
        let begun: Self = serde_json::from_str(&text).map_err(|e| malformed(e.to_string()))?;
        if begun.format != FORMAT {
            return Err(malformed(format!("the format must be \"{FORMAT}\", found \"{}\"", begun.format)));
        }
        Ok(begun)
    }

    /// Refuses answers to another challenge.
    ///
    /// # Errors
    /// [`ChallengeError::OtherChallenge`].
    pub(crate) fn check(&self, folder: &Path, challenge: &Challenge) -> Result<(), ChallengeError> {
        if self.challenge_sha256 == challenge.sha256() {
            return Ok(());
        }
        let theirs = format!("{} version {}, {:.12}", self.suite, self.version, self.challenge_sha256);
        Err(ChallengeError::OtherChallenge { folder: folder.to_owned(), theirs, ours: challenge.name() })
    }

    /// Makes a folder that of this run: empty, or with answers of the same run that go on. The lock ends with the process.
    pub(super) fn settle(&self, folder: &Path, again: bool) -> Result<File, ChallengeError> {
        fs::create_dir_all(cases_folder(folder)).map_err(ChallengeError::writing(folder))?;
        let lock = lock(folder)?;
        let path = folder.join(ANSWERS);
        if path.exists() && !again {
            self.refuse_others(folder)?;
        } else {
            let cases = cases_folder(folder);
            fs::remove_dir_all(&cases).map_err(ChallengeError::writing(&cases))?;
            fs::create_dir_all(&cases).map_err(ChallengeError::writing(&cases))?;
            let text = serde_json::to_string_pretty(self).map_err(io::Error::other);
            write(&path, &(text.map_err(ChallengeError::writing(&path))? + "\n"))?;
        }
        Ok(lock)
    }

    fn refuse_others(&self, folder: &Path) -> Result<(), ChallengeError> {
        let there = Self::read(folder)?;
        if there.challenge_sha256 != self.challenge_sha256 {
            let theirs = format!("{} version {}, {:.12}", there.suite, there.version, there.challenge_sha256);
            let ours = format!("{} version {}, {:.12}", self.suite, self.version, self.challenge_sha256);
            return Err(ChallengeError::OtherChallenge { folder: folder.to_owned(), theirs, ours });
        }
        let what = if there.program != self.program {
            format!("there the program is {}", there.program.join(" "))
        } else if there.name != self.name {
            format!("there the name is {}", there.name)
        } else if there.limits != self.limits {
            let Limits { time_s, memory_mb, output_mb } = there.limits;
            format!("there the limits are {time_s} s, {memory_mb} MB of memory, {output_mb} MB of output")
        } else {
            return Ok(());
        };
        Err(ChallengeError::OtherProgram { folder: folder.to_owned(), what })
    }
}

/// Folder of the answered cases.
pub(crate) fn cases_folder(answers: &Path) -> PathBuf {
    answers.join(CASES)
}

fn lock(folder: &Path) -> Result<File, ChallengeError> {
    let path = folder.join(LOCK);
    let open = File::options().write(true).create(true).truncate(false).open(&path);
    let file = open.map_err(ChallengeError::writing(&path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(ChallengeError::Busy(folder.to_owned())),
        Err(TryLockError::Error(cause)) => Err(ChallengeError::Write { path, cause }),
    }
}
