//! Why a case is not answered.

use std::io;
use std::path::PathBuf;

use crate::application::predict::PredictError;
use crate::error::ModelError;
use hexbench_core::files::FileError;
use thiserror::Error;

/// Why a case is not answered.
#[derive(Debug, Error)]
pub enum AnswerError {
    /// A file that cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The method has no answer.
    #[error("{0}")]
    Model(#[from] ModelError),
    /// A row that cannot be predicted.
    #[error("predict.csv: {0}")]
    Row(#[from] PredictError),
    /// A file that cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
}
