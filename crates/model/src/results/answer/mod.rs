//! The entrants of a challenge that come with hexbench: a case folder in, an answer folder out.
//!
//! Like any other entrant, they get the public files of a case: `hexapod.toml`, `measurements.csv`, `predict.csv`.
//! `docs/guide/challenges.md` defines what they write.

mod case;
mod error;
mod methods;
mod write;

use std::path::Path;

pub use case::CaseFiles;
pub use error::AnswerError;

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
/// [`AnswerError`] when a file cannot be read or written, or when the method has no answer.
pub fn answer(case: &Path, out: &Path, method: Method) -> Result<(), AnswerError> {
    let case = CaseFiles::read(case)?;
    let answer = match method {
        Method::Hexbench => methods::hexbench(&case),
        Method::Paper => methods::paper(&case),
    }?;
    write::answer(out, &case, &answer)
}
