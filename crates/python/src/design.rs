//! Plans of experiments.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::design::{Wish, design as searched, page};
use hexbench_core::Dataset;
use hexbench_core::files::conditions_to_columns;
use hexbench_design::Criterion;
use hexbench_report::render::plain;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

use crate::error::usage;
use crate::machine::PyHexapod;
use crate::run::beside;

/// A plan.
#[pyclass(frozen, name = "Plan", module = "hexbench._native")]
pub(crate) struct PyPlan {
    readings: Dataset,
    /// What makes the plan good.
    #[pyo3(get)]
    criterion: &'static str,
    /// Value of the criterion.
    #[pyo3(get)]
    value: f64,
    /// Least share of the budget that the best plan needs for the same.
    #[pyo3(get)]
    efficiency: Option<f64>,
    /// The page of the command.
    #[pyo3(get)]
    text: String,
}

#[pymethods]
impl PyPlan {
    /// The readings to be taken: the columns of measurements.csv without the measured ones.
    fn columns<'py>(&self, py: Python<'py>) -> Vec<(String, Bound<'py, PyArray1<f64>>)> {
        let columns = conditions_to_columns(&self.readings);
        columns.into_iter().map(|(name, values)| (name, values.into_pyarray(py))).collect()
    }
}

/// What is wanted of a plan.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    poses: Option<u16>,
    repeats: u16,
    readings: Option<u16>,
    hours: Option<f64>,
    candidates: u16,
    criterion: Option<String>,
    terms: Vec<String>,
    starts: Option<u16>,
    seed: u32,
}

/// Search a plan.
#[pyfunction]
pub(crate) fn design(
    py: Python<'_>,
    hexapod: &PyHexapod,
    space: PathBuf,
    wanted: Wanted,
) -> PyResult<PyPlan> {
    let Wanted { poses, repeats, readings, hours, candidates, criterion, terms, starts, seed } = wanted;
    let criterion = criterion.map(|name| named(py, &name)).transpose()?;
    let wish = Wish { poses, repeats, readings, hours, candidates, criterion, terms, starts, seed };
    let machine = Arc::clone(&hexapod.0);
    beside(py, move || {
        let found = searched(&machine.hexapod, &space, &wish, &|_| Box::new(|| ()))?;
        Ok(PyPlan {
            readings: found.readings_to_take(),
            criterion: found.criterion,
            value: found.value,
            efficiency: found.efficiency,
            text: plain(&page(&found)),
        })
    })
}

fn named(py: Python<'_>, name: &str) -> PyResult<Criterion> {
    Criterion::of_option(name).ok_or_else(|| {
        let known = Criterion::ALL.map(Criterion::option).join(", ");
        usage(py, &format!("there is no criterion \"{name}\""), &format!("Use one of {known}."))
    })
}
