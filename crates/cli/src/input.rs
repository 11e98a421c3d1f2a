//! Reading input files, with their warnings told on standard error.

use std::path::Path;

pub(crate) use hexbench_app::input::{catalogue_with, model, user_terms};
use hexbench_core::files::{TableReading, read_conditions, read_hexapod, read_measurements, read_plan};
use hexbench_core::{Dataset, Hexapod};

use crate::failure::Failure;
use crate::output::report;

/// The machine of a hexapod file.
pub(crate) fn hexapod(path: &Path) -> Result<Hexapod, Failure> {
    Ok(read_hexapod(path)?)
}

/// The measurements of a file; what the reader noticed goes to standard error.
pub(crate) fn measurements(path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_measurements(path)?))
}

/// Poses and loads that need no measurement.
pub(crate) fn conditions(path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_conditions(path)?))
}

/// Poses and loads to be measured.
pub(crate) fn plan(path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_plan(path)?))
}

fn told(path: &Path, reading: TableReading) -> Dataset {
    for warning in &reading.warnings {
        report::warn(&format!("{}: {warning}", path.display()), warning.next_step());
    }
    reading.dataset
}
