//! How a run of one case went: `run.json`.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::challenge::ChallengeError;
use crate::challenge::folder::RUN;
use crate::challenge::stored::{Stored, read_json};

/// How a run of one case went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunRecord {
    /// `run/1`.
    pub format: String,
    /// Id of the case.
    pub case: String,
    /// Digest of the public files it was answered from.
    pub case_sha256: String,
    /// How the program ended.
    pub end: End,
    /// Exit code, or number of the signal that ended it.
    pub code: Option<i32>,
    /// Why there is no answer; none when there is one.
    pub failure: Option<String>,
    /// Files of the answer.
    pub files: Vec<String>,
    /// Wall time, s.
    pub wall_s: f64,
    /// Most memory that all processes held together, as sampled, MB; none where the system does not tell.
    #[serde(rename = "peak_memory_MB")]
    pub peak_memory_mb: Option<f64>,
}

/// How a program ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// By itself, with an exit code.
    Exited,
    /// A function of the calling program, by an exception.
    Raised,
    /// By a signal.
    Killed,
    /// Ended because it took too long.
    TimeLimit,
    /// Ended because its processes held too much memory.
    MemoryLimit,
    /// Ended because it wrote too much.
    OutputLimit,
}

impl Stored for RunRecord {
    const FORMAT: &'static str = "run/1";

    fn format(&self) -> &str {
        &self.format
    }
}

impl RunRecord {
    pub(super) fn new(case: &str, case_sha256: String, end: End, code: Option<i32>) -> Self {
        Self {
            format: Self::FORMAT.to_owned(),
            case: case.to_owned(),
            case_sha256,
            end,
            code,
            failure: None,
            files: Vec::new(),
            wall_s: 0.0,
            peak_memory_mb: None,
        }
    }

    /// The record in the folder of an answered case.
    ///
    /// # Errors
    /// [`crate::ExperimentError::Read`], [`ChallengeError::Malformed`].
    pub fn read(folder: &Path) -> Result<Self, ChallengeError> {
        read_json(&folder.join(RUN))
    }
}
