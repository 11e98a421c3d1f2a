//! Files of this crate's own formats, written by it and read back.

use std::path::Path;

use hexbench_core::parser_words::{of_json, of_toml};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::challenge::ChallengeError;
use crate::error::ExperimentError;

/// A file of one format, which it states.
pub(crate) trait Stored: DeserializeOwned {
    /// Name and version of the format.
    const FORMAT: &'static str;

    /// What the file states.
    fn format(&self) -> &str;
}

/// Reads a JSON file.
pub(crate) fn read_json<T: Stored>(path: &Path) -> Result<T, ChallengeError> {
    read(path, |text| serde_json::from_str(text).map_err(|e| of_json(&e))).map(|(stored, _)| stored)
}

/// Reads a TOML file; its text too.
pub(crate) fn read_toml<T: Stored>(path: &Path) -> Result<(T, String), ChallengeError> {
    read(path, |text| toml::from_str(text).map_err(|e| of_toml(text, &e)))
}

/// The text of a JSON file: plain numbers and words, nothing that JSON lacks.
pub(crate) fn json(stored: &impl Serialize) -> String {
    serde_json::to_string_pretty(stored).unwrap_or_default() + "\n"
}

fn read<T: Stored>(
    path: &Path,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<(T, String), ChallengeError> {
    let text = std::fs::read_to_string(path).map_err(ExperimentError::reading(path))?;
    let malformed = |why: String| ChallengeError::Malformed { path: path.to_owned(), why };
    let stored = parse(&text).map_err(malformed)?;
    if stored.format() != T::FORMAT {
        let why = format!("the format must be \"{}\", found \"{}\"", T::FORMAT, stored.format());
        return Err(malformed(why));
    }
    Ok((stored, text))
}
