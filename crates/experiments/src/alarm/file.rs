//! A committed baseline as a file.

use std::io;
use std::path::Path;

use hexbench_core::files::atomic_write;
use hexbench_core::parser_words::of_json;
use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// Why a baseline cannot be read or written.
#[derive(Debug, Error)]
pub enum BaselineFileError {
    /// There is none, or it cannot be read.
    #[error("{path}: cannot be read: {cause}")]
    Unreadable {
        /// The file.
        path: String,
        /// Why not.
        cause: io::Error,
    },
    /// Not JSON, or not what a baseline has.
    #[error("{path}: is not a baseline: {}", of_json(cause))]
    Malformed {
        /// The file.
        path: String,
        /// Line, column and reason.
        cause: serde_json::Error,
    },
    /// Another format.
    #[error("{path}: has the format `{found}` instead of `{wanted}`")]
    Format {
        /// The file.
        path: String,
        /// What it says.
        found: String,
        /// What it should say.
        wanted: &'static str,
    },
    /// A reason that says nothing.
    #[error("a baseline cannot be changed without a reason")]
    NoReason,
    /// It cannot be written.
    #[error("{path}: cannot be written: {cause}")]
    Unwritable {
        /// The file.
        path: String,
        /// Why not.
        cause: io::Error,
    },
}

impl BaselineFileError {
    /// What to do about it; `make` is the command that makes a baseline.
    pub fn next_step(&self, make: &str) -> String {
        match self {
            Self::Unreadable { .. } => format!("Name it with --baseline, or make one with `{make}`."),
            Self::Malformed { .. } | Self::Format { .. } => {
                format!(
                    "Restore the file from version control, or move it away and make a new one with `{make}`."
                )
            }
            Self::NoReason => "Add --reason TEXT: what changed, and why it is intended.".to_owned(),
            Self::Unwritable { .. } => {
                "Check the folder, the free space and the permission to write.".to_owned()
            }
        }
    }

    /// True when the file system stands in the way, and not what the file says.
    pub fn is_input_output(&self) -> bool {
        matches!(self, Self::Unreadable { .. } | Self::Unwritable { .. })
    }
}

/// Reads a baseline of a format, which the key `format` states.
///
/// # Errors
/// [`BaselineFileError::Unreadable`], [`BaselineFileError::Malformed`], [`BaselineFileError::Format`].
pub fn read<T: DeserializeOwned>(path: &Path, wanted: &'static str) -> Result<T, BaselineFileError> {
    let name = || path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|cause| BaselineFileError::Unreadable { path: name(), cause })?;
    let malformed = |cause| BaselineFileError::Malformed { path: name(), cause };
    let any: serde_json::Value = serde_json::from_str(&text).map_err(malformed)?;
    if let Some(found) = any["format"].as_str().filter(|found| *found != wanted) {
        return Err(BaselineFileError::Format { path: name(), found: found.to_owned(), wanted });
    }
    serde_json::from_str(&text).map_err(malformed)
}

/// Writes a baseline whole or not at all.
///
/// # Errors
/// [`BaselineFileError::Unwritable`].
pub fn write(path: &Path, baseline: &impl Serialize) -> Result<(), BaselineFileError> {
    let cause = |cause| BaselineFileError::Unwritable { path: path.display().to_string(), cause };
    let text = serde_json::to_string_pretty(baseline).map_err(|e| cause(e.into()))? + "\n";
    atomic_write(path, |out| out.write_all(text.as_bytes())).map_err(cause)
}
