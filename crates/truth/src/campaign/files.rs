//! The folder of a case.

use std::{fs, path::Path};

use hexbench_core::{
    Hexapod,
    files::{atomic_write, write_campaign, write_hexapod},
};

use super::SimulatedCase;
use crate::TruthError;

impl SimulatedCase {
    /// Writes `hexapod.toml`, `measurements.csv`, `holdout.csv` and `truth.json` to a folder, which is made.
    ///
    /// # Errors
    /// [`TruthError::File`].
    pub fn write(&self, folder: &Path) -> Result<(), TruthError> {
        fs::create_dir_all(folder).map_err(|e| failed(folder, &e))?;
        let hexapod = Hexapod { name: format!("case {}", self.spec.id), ..self.hexapod.clone() };
        let path = |name: &str| folder.join(name);
        write_hexapod(&path("hexapod.toml"), &hexapod).map_err(|e| failed(folder, &e.message()))?;
        for (name, rows) in [("measurements.csv", &self.measurements), ("holdout.csv", &self.holdout)] {
            write_campaign(&path(name), &self.hexapod, rows)
                .map_err(|e| failed(&path(name), &e.message()))?;
        }
        let truth = path("truth.json");
        atomic_write(&truth, |out| writeln!(out, "{:#}", self.truth)).map_err(|e| failed(&truth, &e))
    }
}

fn failed(path: &Path, why: &dyn ToString) -> TruthError {
    TruthError::File { path: path.display().to_string(), why: why.to_string() }
}
