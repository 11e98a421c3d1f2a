//! What is wrong with an answer, and where.

use hexbench_core::parser_words::of_json;
use thiserror::Error;

/// What is wrong with an answer: file, place, rule, and what to write instead.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}{}: {rule}", if place.is_empty() { String::new() } else { format!(": {place}") })]
pub struct AnswerFault {
    /// Name of the file.
    pub file: &'static str,
    /// Where in it; empty for the whole.
    pub place: String,
    /// What is wrong there.
    pub rule: String,
    /// What to write instead; empty where the rule says it.
    pub next: String,
}

impl AnswerFault {
    pub(super) fn new(file: &'static str, place: &str, rule: &str) -> Self {
        Self { file, place: place.to_owned(), rule: rule.to_owned(), next: String::new() }
    }

    /// The same with what to write instead.
    pub(super) fn then(self, next: impl Into<String>) -> Self {
        Self { next: next.into(), ..self }
    }

    /// What the parser found, with line and column.
    pub(super) fn json(file: &'static str, found: &serde_json::Error) -> Self {
        Self::new(file, "", &of_json(found))
            .then("Compare the file with the example in the README.md of the challenge.")
    }
}

/// Line and column of the `index`-th place, from 0, at which a key stands in a text; nothing where it does not.
pub(super) fn place_of_key(text: &str, key: &str, index: usize) -> String {
    let quoted = format!("\"{key}\"");
    let Some((at, _)) = text.match_indices(&quoted).nth(index) else { return String::new() };
    let before = &text[..at];
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("line {line}, column {column}: ")
}
