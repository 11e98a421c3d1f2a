//! The catalogue of effects.

use hexbench_model::terms::catalogue;
use pyo3::prelude::*;
use serde_json::json;

use crate::json::loaded;

/// Every term of the catalogue.
#[pyfunction]
pub(crate) fn terms(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let all = catalogue();
    let told = all.iter().map(|term| {
        let info = term.info();
        let parameters = info.parameters.iter().map(|p| json!({ "name": p.name, "unit": p.unit }));
        json!({
            "id": info.id,
            "title": info.title,
            "physics": info.physics,
            "equation": info.equation,
            "source": info.source,
            "shows": info.shows,
            "breaker": info.how_to_isolate,
            "parameters": parameters.collect::<Vec<_>>(),
            "shape": info.shape.map(|s| json!({ "name": s.name, "unit": s.unit })),
        })
    });
    loaded(py, &told.collect::<Vec<_>>())
}
