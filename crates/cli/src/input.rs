//! Reading input files, with their warnings told on standard error.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hexbench_core::files::{Reading, read_conditions, read_hexapod, read_measurements, read_plan};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::model_file::Model;
use hexbench_model::term::Term;
use hexbench_model::terms::catalogue;
use hexbench_model::user_term;

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

fn told(path: &Path, reading: Reading) -> Dataset {
    for warning in &reading.warnings {
        report::warn(&format!("{}: {warning}", path.display()), warning.next_step());
    }
    reading.dataset
}

/// A fitted model.
pub(crate) fn model(path: &Path) -> Result<Model, Failure> {
    let unreadable = |cause| Failure::Unreadable { path: path.to_owned(), cause };
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    Model::from_toml(&text)
        .map_err(|cause| Failure::ModelFile { path: path.to_owned(), cause: Box::new(cause) })
}

/// Terms from files of the user.
pub(crate) fn user_terms(paths: &[PathBuf]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let read = |path: &PathBuf| {
        user_term::read(path)
            .map_err(|cause| Failure::UserTerm { path: path.clone(), cause: Box::new(cause) })
    };
    paths.iter().map(read).collect()
}

/// The catalogue and the user's own terms.
pub(crate) fn catalogue_with(own: &[Arc<dyn Term>]) -> Vec<Arc<dyn Term>> {
    catalogue().into_iter().chain(own.iter().map(Arc::clone)).collect()
}
