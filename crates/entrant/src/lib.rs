//! The bench's own entrants of a challenge: a case folder in, an answer folder out.
//!
//! This crate sees the model side alone. What it is given are the public files of a case, as any other entrant: `hexapod.toml`,
//! `measurements.csv`, `predict.csv`. What it writes is the contract of `docs/challenges.md`.

mod case;
mod error;
mod methods;
mod write;

use std::path::Path;

pub use case::Case;
pub use error::EntrantError;

/// How a case is answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The whole diagnosis: effects with their probabilities, stiffnesses averaged over what remains possible, predictions of
    /// the best model.
    Hexbench,
    /// The paper's estimator: unweighted least squares of six springs, nothing else.
    Paper,
}

/// Answers the case in a folder.
///
/// # Errors
/// [`EntrantError`] when a file cannot be read or written, or when the method has no answer.
pub fn answer(case: &Path, out: &Path, method: Method) -> Result<(), EntrantError> {
    let case = Case::read(case)?;
    let answer = match method {
        Method::Hexbench => methods::hexbench(&case),
        Method::Paper => methods::paper(&case),
    }?;
    write::answer(out, &case, &answer)
}
