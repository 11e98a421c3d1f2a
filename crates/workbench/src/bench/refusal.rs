//! Why a request is refused.

use hexbench_core::files::FileError;
use hexbench_model::application::model_file::ModelFileError;
use hexbench_model::effects::user_term::UserTermError;
use hexbench_model::error::ModelError;
use hexbench_report::charts::ReportError;
use hexbench_truth::TruthError;

/// What kind of refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefusalKind {
    /// The input says something that cannot be used.
    BadInput,
    /// Nothing of this name.
    Unknown,
    /// More than the limits allow.
    TooLarge,
    /// Not a question for this bench.
    Conflict,
}

/// A question without an answer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Refusal {
    /// Its kind.
    pub kind: RefusalKind,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub next: String,
}

impl Refusal {
    /// A refusal.
    pub fn new(kind: RefusalKind, message: impl Into<String>, next: impl Into<String>) -> Self {
        Self { kind, message: message.into(), next: next.into() }
    }

    /// Something that cannot be used.
    pub(super) fn bad_input(message: impl Into<String>, next: impl Into<String>) -> Self {
        Self::new(RefusalKind::BadInput, message, next)
    }

    /// Nothing of this name.
    pub(super) fn unknown(what: &str, name: &str) -> Self {
        Self::new(
            RefusalKind::Unknown,
            format!("there is no {what} `{name}`"),
            "Choose one from the catalogue.",
        )
    }

    /// A model that cannot be computed from the data of a file.
    pub(super) fn model(cause: &ModelError, data: &str) -> Self {
        Self::bad_input(cause.to_string(), cause.next_step(data))
    }

    /// A term file that is none.
    pub(super) fn own_term(number: usize, cause: &UserTermError) -> Self {
        let which = if number == 0 { String::new() } else { format!("term file {}: ", number + 1) };
        Self::bad_input(
            format!("{which}{cause}"),
            "Correct the term; the help below the formula lists what it may use.",
        )
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        Self::bad_input(error.to_string(), error.next_step())
    }
}

impl From<TruthError> for Refusal {
    fn from(error: TruthError) -> Self {
        Self::bad_input(error.to_string(), "Choose another plan, effect, distance or seed.")
    }
}

impl From<ModelFileError> for Refusal {
    fn from(error: ModelFileError) -> Self {
        Self::bad_input(error.to_string(), "Leave out terms that the data do not determine.")
    }
}

impl From<ReportError> for Refusal {
    fn from(error: ReportError) -> Self {
        Self::bad_input(
            format!("the report cannot be drawn: {error}"),
            "Check the data for readings of wrong size or unit.",
        )
    }
}
