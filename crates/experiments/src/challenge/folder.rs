//! Names of the files of a challenge and of answers.

use std::fs;
use std::io;
use std::path::Path;

use crate::challenge::ChallengeError;
use crate::error::ExperimentError;

/// Folder of the public cases.
pub(crate) const CASES: &str = "cases";
/// Folder of the truth.
pub(crate) const SEALED: &str = "sealed";
/// The machine.
pub(crate) const HEXAPOD: &str = "hexapod.toml";
/// Readings to learn from.
pub(crate) const MEASUREMENTS: &str = "measurements.csv";
/// Poses and wrenches to predict.
pub(crate) const PREDICT: &str = "predict.csv";
/// The contract for entrants.
pub(crate) const README: &str = "README.md";
/// Public files of a case.
pub(crate) const PUBLIC: [&str; 3] = [HEXAPOD, MEASUREMENTS, PREDICT];
/// What was hidden.
pub(crate) const TRUTH: &str = "truth.json";
/// Held-out readings without noise.
pub(crate) const TRUE_READINGS: &str = "true.csv";
/// Held-out readings as measured.
pub(crate) const MEASURED: &str = "measured.csv";

/// Answers: leg stiffnesses and other numbers.
pub(crate) const PARAMETERS: &str = "parameters.json";
/// Answers: the rows of `predict.csv`.
pub(crate) const PREDICTIONS: &str = "predictions.csv";
/// Answers: what is behind the residuals.
pub(crate) const DIAGNOSIS: &str = "diagnosis.json";
/// Files of an answer.
pub(crate) const ANSWER: [&str; 3] = [PREDICTIONS, PARAMETERS, DIAGNOSIS];
/// How a run went.
pub(crate) const RUN: &str = "run.json";

/// Refuses a folder that holds anything but what is known.
pub(crate) fn refuse_content(folder: &Path, known: &[&str]) -> Result<(), ChallengeError> {
    let foreign = |entry: io::Result<fs::DirEntry>| {
        entry.is_ok_and(|e| !known.iter().any(|name| e.file_name() == *name))
    };
    match fs::read_dir(folder).map(|mut entries| entries.any(foreign)) {
        Ok(true) => Err(ChallengeError::NotEmpty(folder.to_owned())),
        Ok(false) => Ok(()),
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(cause) => Err(ExperimentError::writing(folder)(cause).into()),
    }
}
