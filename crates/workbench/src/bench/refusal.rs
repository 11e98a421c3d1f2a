//! Why a question has no answer.

/// What kind of refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
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
    pub kind: Kind,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub next: String,
}

impl Refusal {
    /// Something that cannot be used.
    pub fn bad_input(message: impl Into<String>, next: impl Into<String>) -> Self {
        Self { kind: Kind::BadInput, message: message.into(), next: next.into() }
    }
}
