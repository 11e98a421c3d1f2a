//! Reading input files, with their warnings told on standard error.

use std::path::Path;

use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{Dataset, Hexapod};

use crate::failure::Failure;
use crate::output::report;

/// The machine of a hexapod file.
pub(crate) fn hexapod(path: &Path) -> Result<Hexapod, Failure> {
    Ok(read_hexapod(path)?)
}

/// The measurements of a file; what the reader noticed goes to standard error.
pub(crate) fn measurements(path: &Path) -> Result<Dataset, Failure> {
    let reading = read_measurements(path)?;
    for warning in &reading.warnings {
        report::warn(&format!("{}: {warning}", path.display()), warning.next_step());
    }
    Ok(reading.dataset)
}
