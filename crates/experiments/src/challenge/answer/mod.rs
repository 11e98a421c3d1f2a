//! What a program wrote, read strictly: every fault is told with file and place.

mod diagnosis;
mod fault;
mod parameters;
mod predictions;

use std::fs;
use std::io;
use std::path::Path;

use hexbench_core::Measurand;

use crate::challenge::folder::{DIAGNOSIS, PARAMETERS, PREDICTIONS};
pub use diagnosis::{StatedCandidate, StatedDiagnosis};
pub use fault::AnswerFault;
pub use parameters::Number;
pub use predictions::{Predicted, columns};

/// An answer to one case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseAnswer {
    /// One per row of `predict.csv`, in its order.
    pub predictions: Vec<Predicted>,
    /// Numbers with names; empty when the file is not there.
    pub parameters: Vec<Number>,
    /// What is behind the residuals, when it is said.
    pub said: Option<StatedDiagnosis>,
}

impl CaseAnswer {
    /// Reads the answer in a folder to a case with so many rows to predict.
    ///
    /// # Errors
    /// The first fault, with file and place.
    pub fn read(folder: &Path, rows: usize, measurand: Measurand) -> Result<Self, AnswerFault> {
        let predictions = text(folder, PREDICTIONS)?
            .ok_or_else(|| AnswerFault::new(PREDICTIONS, "", "the file is not there"))?;
        Ok(Self {
            predictions: predictions::read(&predictions, rows, measurand)?,
            parameters: text(folder, PARAMETERS)?.map_or(Ok(Vec::new()), |t| parameters::read(&t))?,
            said: text(folder, DIAGNOSIS)?.map(|t| diagnosis::read(&t)).transpose()?,
        })
    }
}

/// Text of a file; none when it is not there.
fn text(folder: &Path, name: &'static str) -> Result<Option<String>, AnswerFault> {
    match fs::read(folder.join(name)) {
        Ok(bytes) => match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(wrong) => {
                let place = format!("byte {}", wrong.utf8_error().valid_up_to());
                Err(AnswerFault::new(name, &place, "this is not UTF-8 text"))
            }
        },
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(cause) => Err(AnswerFault::new(name, "", &format!("cannot be read: {cause}"))),
    }
}
