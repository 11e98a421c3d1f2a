//! Commands as functions: the words of a command line in, what it has written out.

use std::ffi::OsString;

use hexbench_app::Exit;
use pyo3::prelude::*;

use crate::run::beside;

/// Run a command; what it wrote to standard output, and whether the check it made passed.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<OsString>) -> PyResult<(String, bool)> {
    beside(py, move || {
        let output = hexbench_cli::output_of(words);
        match output.end {
            Ok(()) => Ok((output.text, true)),
            Err(failure) if matches!(failure.exit(), Exit::CheckFailed) => Ok((output.text, false)),
            Err(failure) => Err(failure),
        }
    })
}

/// Names of all commands.
#[pyfunction]
pub(crate) fn command_names() -> Vec<String> {
    hexbench_cli::names()
}
