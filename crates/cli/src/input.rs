//! Reading input files, with their warnings told on standard error.

use std::path::Path;

pub(crate) use hexbench_app::input::{catalogue_with, model, user_terms};
use hexbench_core::files::{TableReading, read_campaign, read_conditions, read_hexapod, read_plan};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::results::diagnose::misread_findings;
use hexbench_model::terms::catalogue;

use crate::failure::Failure;
use crate::output::report;
use crate::read_as::ReadAs;

/// The machine of a hexapod file.
pub(crate) fn hexapod(path: &Path) -> Result<Hexapod, Failure> {
    Ok(read_hexapod(path)?)
}

/// The measurements of a file of a machine; what the reader noticed goes to standard error.
pub(crate) fn measurements(hexapod: &Hexapod, path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_campaign(hexapod, path)?))
}

/// Poses and loads that need no measurement.
pub(crate) fn conditions(path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_conditions(path)?))
}

/// Poses and loads to be measured.
pub(crate) fn plan(path: &Path) -> Result<Dataset, Failure> {
    Ok(told(path, read_plan(path)?))
}

/// The same as the sensors of a machine will read it: measurements by what was read, a plan by every sensor.
pub(crate) fn plan_of(hexapod: &Hexapod, path: &Path) -> Result<Dataset, Failure> {
    if hexapod.sensors.is_empty() {
        return plan(path);
    }
    match read_campaign(hexapod, path) {
        Ok(measured) => Ok(told(path, measured)),
        Err(_) => Ok(plan(path)?.to_be_read_by(&hexapod.sensors)),
    }
}

/// Says on standard error how files are read otherwise than they say, and what they seem to mean instead.
pub(crate) fn warn_of_misread(hexapod: &Hexapod, data: &Dataset, read_as: &ReadAs) {
    let all = read_as.names();
    if !all.is_empty() {
        report::note(&format!(
            "the files are read otherwise than they say, as asked: {}",
            all.join(", then ")
        ));
    }
    for finding in misread_findings(hexapod, data, &catalogue()).into_iter().flatten().take(1) {
        report::warn(&finding.text, &finding.next);
    }
}

fn told(path: &Path, reading: TableReading) -> Dataset {
    for warning in &reading.warnings {
        report::warn(&format!("{}: {warning}", path.display()), warning.next_step());
    }
    reading.dataset
}
