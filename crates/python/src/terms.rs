//! The catalogue of effects.

use hexbench_model::results::terms::TermList;
use hexbench_model::terms::catalogue;
use pyo3::prelude::*;

use crate::json::loaded;

/// Every term of the catalogue.
#[pyfunction]
pub(crate) fn terms(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    loaded(py, &TermList::of(&catalogue()).terms)
}
