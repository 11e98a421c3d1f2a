//! The public files of a case.

use std::path::Path;

use hexbench_core::files::{read_conditions, read_hexapod, read_measurements};
use hexbench_core::{Dataset, Hexapod};

use super::AnswerError;

/// The public files of a case.
#[derive(Debug, Clone)]
pub struct CaseFiles {
    /// The machine.
    pub hexapod: Hexapod,
    /// Readings to learn from.
    pub measurements: Dataset,
    /// Poses and loads to predict, row by row.
    pub asked: Dataset,
}

impl CaseFiles {
    /// Reads a case folder.
    ///
    /// # Errors
    /// The first thing that is wrong with a file.
    pub fn read(folder: &Path) -> Result<Self, AnswerError> {
        Ok(Self {
            hexapod: read_hexapod(&folder.join("hexapod.toml"))?,
            measurements: read_measurements(&folder.join("measurements.csv"))?.dataset,
            asked: read_conditions(&folder.join("predict.csv"))?.dataset,
        })
    }
}
