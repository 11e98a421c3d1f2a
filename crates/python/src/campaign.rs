//! Measurements: from files, from tables in memory, and back.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::Failure;
use hexbench_core::files::{
    Cells, FileError, GroupPurpose, MemoryColumn, TableReading, campaign_to_columns, campaign_to_csv,
    content_hash, read_campaign, read_campaign_from, read_columns,
};
use hexbench_core::{Dataset, Hexapod};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::error::usage;
use crate::machine::{Machine, Origin, PyHexapod};
use crate::run::beside;

/// A machine with its measurements.
#[derive(Debug)]
pub(crate) struct Measured {
    pub(crate) machine: Arc<Machine>,
    pub(crate) data: Dataset,
    pub(crate) origin: Origin,
}

/// A campaign.
#[pyclass(frozen, name = "Campaign", module = "hexbench._native")]
pub(crate) struct PyCampaign(pub(crate) Arc<Measured>);

/// What a reader noticed, each with its next step.
type Noticed = Vec<(String, String)>;

#[pymethods]
impl PyCampaign {
    /// Read measurements.csv.
    #[staticmethod]
    fn read(py: Python<'_>, hexapod: &PyHexapod, path: PathBuf) -> PyResult<(Self, Noticed)> {
        let machine = Arc::clone(&hexapod.0);
        beside(py, move || {
            let reading = read_campaign(&machine.hexapod, &path)?;
            let origin = Origin { name: path.display().to_string(), sha256: content_hash(&path)? };
            Ok(Self::of(machine, reading, origin))
        })
    }

    /// Read the text of a measurements.csv, which came from `origin`.
    #[staticmethod]
    fn of_text(
        py: Python<'_>,
        hexapod: &PyHexapod,
        text: String,
        name: String,
        origin: (String, String),
    ) -> PyResult<Self> {
        let machine = Arc::clone(&hexapod.0);
        beside(py, move || {
            let reading = read_campaign_from(&machine.hexapod, text.as_bytes(), &name)?;
            let origin = Origin { name: origin.0, sha256: origin.1 };
            Ok(Self::of(machine, reading, origin).0)
        })
    }

    /// Name and SHA-256 of the file it comes from, or of the one that would be written.
    #[getter]
    fn origin(&self) -> (String, String) {
        self.0.origin.pair()
    }

    /// Read columns in memory.
    #[staticmethod]
    fn of_columns(
        py: Python<'_>,
        hexapod: &PyHexapod,
        names: Vec<String>,
        columns: Vec<Bound<'_, PyAny>>,
        name: String,
    ) -> PyResult<(Self, Noticed)> {
        let machine = Arc::clone(&hexapod.0);
        let columns = memory_columns(py, names, &columns)?;
        beside(py, move || {
            let reading = read_columns(&columns, &name, GroupPurpose::Measurements, Some(&machine.hexapod))?;
            let origin = Origin::in_memory(&name, &csv(&machine.hexapod, &reading.dataset));
            Ok(Self::of(machine, reading, origin))
        })
    }

    /// Every column of measurements.csv.
    fn columns<'py>(&self, py: Python<'py>) -> Vec<(String, Bound<'py, PyArray1<f64>>)> {
        let columns = campaign_to_columns(&self.0.machine.hexapod, &self.0.data);
        columns.into_iter().map(|(name, values)| (name, values.into_pyarray(py))).collect()
    }

    /// The text of measurements.csv.
    fn to_csv(&self) -> String {
        csv(&self.0.machine.hexapod, &self.0.data)
    }

    /// Number of readings.
    #[getter]
    fn readings(&self) -> usize {
        self.0.data.rows().count()
    }

    /// True for absolute poses.
    #[getter]
    fn absolute(&self) -> bool {
        self.0.data.is_absolute()
    }

    /// What messages call the data.
    #[getter]
    fn name(&self) -> &str {
        &self.0.data.source
    }
}

impl PyCampaign {
    /// Readings of a simulated machine.
    pub(crate) fn simulated(machine: &PyHexapod, data: Dataset) -> Self {
        let machine = Arc::clone(&machine.0);
        let origin = Origin::in_memory(&data.source, &csv(&machine.hexapod, &data));
        Self(Arc::new(Measured { machine, data, origin }))
    }

    fn of(machine: Arc<Machine>, reading: TableReading, origin: Origin) -> (Self, Noticed) {
        let in_words =
            |w: &hexbench_core::files::Warning| (format!("{}: {w}", origin.name), w.next_step().to_owned());
        let noticed = reading.warnings.iter().map(in_words).collect();
        (Self(Arc::new(Measured { machine, data: reading.dataset, origin })), noticed)
    }
}

/// The file that would be written. Numbers that a reader has passed can be written.
fn csv(hexapod: &Hexapod, data: &Dataset) -> String {
    let mut text = Vec::new();
    let _ = campaign_to_csv(&mut text, hexapod, data);
    String::from_utf8_lossy(&text).into_owned()
}

/// Columns as Python gives them: an array of floats, or a list of texts.
fn memory_columns(
    py: Python<'_>,
    names: Vec<String>,
    columns: &[Bound<'_, PyAny>],
) -> PyResult<Vec<MemoryColumn>> {
    if names.len() != columns.len() {
        return Err(usage(py, &format!("{} names for {} columns", names.len(), columns.len()), ""));
    }
    let read = |(name, column): (String, &Bound<'_, PyAny>)| {
        let cells = match column.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(array) => Cells::Numbers(array.as_array().iter().copied().collect()),
            Err(_) => Cells::Texts(column.extract()?),
        };
        Ok(MemoryColumn { name, cells })
    };
    names.into_iter().zip(columns).map(read).collect()
}

/// Poses and loads that need no measurement, from columns in memory.
pub(crate) fn conditions(
    py: Python<'_>,
    names: Vec<String>,
    columns: &[Bound<'_, PyAny>],
    name: &str,
) -> PyResult<Dataset> {
    let columns = memory_columns(py, names, columns)?;
    let name = name.to_owned();
    beside(py, move || {
        read_columns(&columns, &name, GroupPurpose::Conditions, None)
            .map(|reading| reading.dataset)
            .map_err(|cause: FileError| Failure::File(cause))
    })
}
