//! Commands as functions: the words of a command line in, what it has written out.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::run::beside;

/// Run a command; what it wrote to standard output, and whether the check it made passed.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<OsString>) -> PyResult<(String, bool)> {
    beside(py, move || hexbench_cli::output_of(words))
}

/// Names of all commands.
#[pyfunction]
pub(crate) fn command_names() -> Vec<String> {
    hexbench_cli::names()
}
