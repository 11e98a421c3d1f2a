//! The public files of a case.

use std::path::Path;

use hexbench_core::files::{read_campaign, read_conditions, read_hexapod};
use hexbench_core::{Dataset, Hexapod, Measurand};

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
        let hexapod = read_hexapod(&folder.join("hexapod.toml"))?;
        Ok(Self {
            measurements: read_campaign(&hexapod, &folder.join("measurements.csv"))?.dataset,
            hexapod,
            asked: read_conditions(&folder.join("predict.csv"))?.dataset,
        })
    }

    /// What is to be predicted: what was read, or full poses where sensors read or cells are empty.
    pub(super) fn predicted(&self) -> Measurand {
        if self.measurements.has_other_readings() {
            Measurand::DeflectionEuler
        } else {
            self.measurements.measurand
        }
    }
}
