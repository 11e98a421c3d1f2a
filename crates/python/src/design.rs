//! Plans of experiments.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::design::{
    ChosenSensors, SensorWish, Wish, choose_sensors as chosen, design as searched, page,
};
use hexbench_core::Dataset;
use hexbench_core::files::{conditions_to_columns, hexapod_to_toml, read_plan};
use hexbench_design::Criterion;
use hexbench_report::Page;
use hexbench_report::render::plain;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

use crate::error::usage;
use crate::json::loaded;
use crate::machine::{Machine, Origin, PyHexapod};
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
    let shown = Vec::new();
    let wish = Wish { poses, repeats, readings, hours, candidates, criterion, terms, shown, starts, seed };
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

/// Sensors out of candidates.
#[pyclass(frozen, name = "SensorChoice", module = "hexbench._native")]
pub(crate) struct PySensorChoice {
    found: ChosenSensors,
    /// Name of the file of the machine.
    machine: String,
    /// The page of the command.
    #[pyo3(get)]
    text: String,
}

#[pymethods]
impl PySensorChoice {
    /// What `--json` writes.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        loaded(py, &self.found.file())
    }

    /// The machine with the chosen sensors beside those it had.
    fn hexapod(&self) -> PyHexapod {
        let hexapod = self.found.hexapod.clone();
        let origin = Origin::in_memory(&self.machine, &hexapod_to_toml(&hexapod));
        PyHexapod(Arc::new(Machine { hexapod, origin }))
    }
}

/// What is wanted of sensors.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct WantedSensors {
    choose: Option<u16>,
    budget: Option<f64>,
    see: Option<String>,
    criterion: Option<String>,
    terms: Vec<String>,
    starts: Option<u16>,
    seed: u32,
}

/// Choose sensors for the rows of a plan.
#[pyfunction]
pub(crate) fn choose_sensors(
    py: Python<'_>,
    hexapod: &PyHexapod,
    plan: PathBuf,
    candidates: PathBuf,
    wanted: WantedSensors,
) -> PyResult<PySensorChoice> {
    let WantedSensors { choose, budget, see, criterion, terms, starts, seed } = wanted;
    let criterion = criterion.map(|name| named(py, &name)).transpose()?;
    let wish = SensorWish { choose, budget, see, criterion, terms, starts, seed };
    let machine = Arc::clone(&hexapod.0);
    beside(py, move || {
        let plan = read_plan(&plan, Some(&machine.hexapod))?.dataset;
        let found = chosen(&machine.hexapod, &plan, &candidates, &wish, &|_| Box::new(|| ()))?;
        let page = found.page();
        let page = Page { title: String::new(), ..page };
        Ok(PySensorChoice { text: plain(&page), found, machine: machine.origin.name.clone() })
    })
}

fn named(py: Python<'_>, name: &str) -> PyResult<Criterion> {
    Criterion::of_option(name).ok_or_else(|| {
        let known = Criterion::ALL.map(Criterion::option).join(", ");
        usage(py, &format!("there is no criterion \"{name}\""), &format!("Use one of {known}."))
    })
}
