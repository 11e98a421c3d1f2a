//! A failure as a Python exception.

use hexbench_app::{Exit, Failure};
use pyo3::prelude::*;

/// The module with the classes.
const MODULE: &str = "hexbench.errors";

/// The exception of a failure: its class says what the exit code of the command says, its text is the command's.
pub(crate) fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
    let class = match failure.exit() {
        Exit::Usage => "UsageError",
        Exit::BadInput => "BadInput",
        Exit::NotDetermined => "NotDetermined",
        Exit::InputOutput => "InputOutput",
        Exit::Done | Exit::CheckFailed => "HexbenchError",
    };
    exception(py, class, &failure.to_string(), failure.next_step().as_deref())
}

/// Wrong usage that the command's own arguments would have refused.
pub(crate) fn usage(py: Python<'_>, message: &str, next: &str) -> PyErr {
    exception(py, "UsageError", message, Some(next))
}

/// A fault of this program.
pub(crate) fn internal(py: Python<'_>, what: &str) -> PyErr {
    let message = format!("the computation stopped: {what}");
    exception(py, "HexbenchError", &message, Some("This is an error of hexbench; please report it."))
}

fn exception(py: Python<'_>, class: &str, message: &str, next: Option<&str>) -> PyErr {
    let made = py.import(MODULE).and_then(|module| module.getattr(class)?.call1((message, next)));
    made.map_or_else(|other| other, PyErr::from_value)
}
