//! Why an answer cannot be read.

use thiserror::Error;

/// Why an answer cannot be read: file, place, rule.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}{}: {rule}", if place.is_empty() { String::new() } else { format!(": {place}") })]
pub struct AnswerFault {
    /// Name of the file.
    pub file: &'static str,
    /// Where in it; empty for the whole.
    pub place: String,
    /// What is wrong there.
    pub rule: String,
}

impl AnswerFault {
    pub(super) fn new(file: &'static str, place: &str, rule: &str) -> Self {
        Self { file, place: place.to_owned(), rule: rule.to_owned() }
    }

    /// What serde found, with line and column.
    pub(super) fn json(file: &'static str, found: &serde_json::Error) -> Self {
        Self::new(file, "", &found.to_string())
    }
}
