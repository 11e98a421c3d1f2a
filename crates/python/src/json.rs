//! Results as Python's own dictionaries and lists.

use pyo3::prelude::*;
use serde::Serialize;

use crate::error::internal;

/// The value as `json.loads` reads it.
pub(crate) fn loaded<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(value).map_err(|cause| internal(py, &cause.to_string()))?;
    py.import("json")?.getattr("loads")?.call1((text,))
}
