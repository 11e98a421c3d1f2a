//! What the reader accepted but wants to say.

use super::FilePlace;
use super::error::located;
use std::fmt;
use thiserror::Error;

/// Something about a file that was read all the same.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// Where in the file.
    pub place: FilePlace,
    /// What was noticed.
    pub notice: Notice,
}

/// What was noticed. `Display` says it and what was done about it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Notice {
    /// Another separator than the comma.
    #[error("the columns are separated by {0}, not commas; accepted")]
    Separator(&'static str),
    /// Another encoding than UTF-8.
    #[error("the file is not UTF-8 but {0}; read accordingly")]
    Encoding(&'static str),
    /// Decimal commas.
    #[error("numbers are written with a decimal comma; accepted in every cell")]
    DecimalComma,
    /// The names of the columns, word for word again.
    #[error("the names of the columns come again ({}); skipped", listed(lines))]
    NamesAgain {
        /// The lines.
        lines: Vec<u64>,
    },
    /// An unknown column.
    #[error("unknown column, ignored{}", meant.as_ref().map(|name| format!("; perhaps \"{name}\" is meant")).unwrap_or_default())]
    IgnoredColumn {
        /// The column that it may stand for under the name of another program.
        meant: Option<String>,
    },
    /// Rows that are identical in every cell.
    #[error(
        "{} identical in every cell to an earlier one ({}); dropped, because a copy adds no information",
        rows(lines.len()), copies(lines)
    )]
    IdenticalRows {
        /// `[first line, line of the copy]`, in file order.
        lines: Vec<[u64; 2]>,
    },
    /// No newline at the end.
    #[error("the file does not end with a newline; its last number may be truncated")]
    NoFinalNewline,
    /// Loaded equals reference.
    #[error("{} the same wrench in the loaded and in the reference state ({})", have(lines.len()), listed(lines))]
    NoLoadDifference {
        /// The lines.
        lines: Vec<u64>,
    },
}

impl Warning {
    pub(crate) fn new(place: FilePlace, notice: Notice) -> Self {
        Self { place, notice }
    }

    /// What to do if the warning is unwelcome, one sentence.
    pub fn next_step(&self) -> &'static str {
        match self.notice {
            Notice::Encoding(_) => {
                "Nothing if names and notes look right; in a spreadsheet, \"CSV UTF-8\" is the safe choice."
            }
            Notice::Separator(_) | Notice::DecimalComma => {
                "Nothing if the numbers look right; export with commas and decimal points to be safe."
            }
            Notice::NamesAgain { .. } => "Nothing if the tables belong to one machine and one campaign.",
            Notice::IgnoredColumn { meant: None } => {
                "Begin the name with x_ or note if the column is meant to be ignored."
            }
            Notice::IgnoredColumn { meant: Some(_) } => {
                "Rename the column, or begin its name with x_ or note if it is meant to be ignored."
            }
            Notice::IdenticalRows { .. } => {
                "If these are separate readings, number them in the column repeat."
            }
            Notice::NoFinalNewline => "Compare the last line with the original.",
            Notice::NoLoadDifference { .. } => {
                "Check fx ... mz and ref_fx ... ref_mz; such rows show drift and noise, not stiffness."
            }
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&located(&self.place, &self.notice))
    }
}

/// Most lines listed in one message.
const LISTED_LINES: usize = 5;

fn rows(count: usize) -> String {
    if count == 1 { "1 row is".into() } else { format!("{count} rows are") }
}

fn have(count: usize) -> String {
    if count == 1 { "1 row has".into() } else { format!("{count} rows have") }
}

fn copies(lines: &[[u64; 2]]) -> String {
    joined(lines, |[first, copy]| format!("line {copy} = line {first}"))
}

fn listed(lines: &[u64]) -> String {
    let word = if lines.len() == 1 { "line" } else { "lines" };
    format!("{word} {}", joined(lines, u64::to_string))
}

fn joined<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    let mut parts: Vec<String> = items.iter().take(LISTED_LINES).map(text).collect();
    if items.len() > LISTED_LINES {
        parts.push("...".into());
    }
    parts.join(", ")
}
