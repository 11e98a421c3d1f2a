//! The answer of a program, read strictly: every error is reported with file and place.

mod diagnosis;
mod fault;
mod header;
mod lint;
mod parameters;
mod predictions;

use std::fs;
use std::io;
use std::path::Path;

use hexbench_core::Measurand;

use crate::challenge::folder::{DIAGNOSIS, PARAMETERS, PREDICTIONS};
pub use diagnosis::{StatedCandidate, StatedDiagnosis};
pub use fault::AnswerFault;
pub use header::{Predicted, columns};
pub use lint::{AskedCase, Lint, lint};
pub use parameters::Number;

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
        Self::read_all(folder, Some(rows), measurand).map_err(|mut faults| faults.swap_remove(0))
    }

    /// The same; without a number of rows, as many as there are.
    ///
    /// # Errors
    /// Every fault, with file and place; one at least.
    pub(super) fn read_all(
        folder: &Path,
        rows: Option<usize>,
        measurand: Measurand,
    ) -> Result<Self, Vec<AnswerFault>> {
        let mut faults = Vec::new();
        let missing = || {
            AnswerFault::new(PREDICTIONS, "", "the file is not there")
                .then("Write it into the folder of the answer.")
        };
        let predictions =
            of_file(folder, PREDICTIONS, |t| predictions::read(t, rows, measurand), &mut faults);
        if predictions.is_none() && faults.is_empty() {
            faults.push(missing());
        }
        let parameters = of_file(folder, PARAMETERS, parameters::read, &mut faults);
        let said = of_file(folder, DIAGNOSIS, diagnosis::read, &mut faults);
        match predictions {
            Some(predictions) if faults.is_empty() => {
                Ok(Self { predictions, parameters: parameters.unwrap_or_default(), said })
            }
            _ => Err(faults),
        }
    }
}

/// What a file says, if it is there; else what is wrong with it is kept.
fn of_file<T>(
    folder: &Path,
    name: &'static str,
    read: impl Fn(&str) -> Result<T, Vec<AnswerFault>>,
    faults: &mut Vec<AnswerFault>,
) -> Option<T> {
    let found = match text(folder, name) {
        Ok(None) => return None,
        Ok(Some(text)) => read(&text),
        Err(fault) => Err(vec![fault]),
    };
    found.map_err(|of_file| faults.extend(of_file)).ok()
}

/// Text of a file; none when it is not there.
fn text(folder: &Path, name: &'static str) -> Result<Option<String>, AnswerFault> {
    match fs::read(folder.join(name)) {
        Ok(bytes) => match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(wrong) => {
                let place = format!("byte {}", wrong.utf8_error().valid_up_to());
                Err(AnswerFault::new(name, &place, "this is not UTF-8 text").then("Write the file as UTF-8."))
            }
        },
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(cause) => Err(AnswerFault::new(name, "", &format!("cannot be read: {cause}"))),
    }
}
