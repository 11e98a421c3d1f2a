//! The machine.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::Failure;
use hexbench_core::files::{
    Dimension, FileError, atomic_write, content_hash, hexapod_to_toml, parse_hexapod, read_hexapod,
    text_hash, unit_named,
};
use hexbench_core::{Hexapod, Vector3};
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::arrays::rows;
use crate::error::raised;
use crate::own_sensor::{refuse_in_file, share_functions, with_sensor};

/// A machine, and the file it comes from.
#[derive(Debug)]
pub(crate) struct Machine {
    pub(crate) hexapod: Hexapod,
    pub(crate) origin: Origin,
}

/// Where something comes from: for the foot of a page and for the key `run` of a result.
#[derive(Debug, Clone)]
pub(crate) struct Origin {
    /// Name of the file, or what stands for one.
    pub(crate) name: String,
    /// SHA-256 of the file, or of the file that would be written.
    pub(crate) sha256: String,
}

impl Origin {
    /// Of something that is in no file: `text` is what would be written.
    pub(crate) fn in_memory(name: &str, text: &str) -> Self {
        Self { name: name.to_owned(), sha256: text_hash(text) }
    }

    /// Both.
    pub(crate) fn pair(&self) -> (String, String) {
        (self.name.clone(), self.sha256.clone())
    }
}

/// A hexapod.
#[pyclass(frozen, name = "Hexapod", module = "hexbench._native")]
pub(crate) struct PyHexapod(pub(crate) Arc<Machine>);

#[pymethods]
impl PyHexapod {
    /// Read hexapod.toml.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = || {
            let hexapod = read_hexapod(&path)?;
            let origin = Origin { name: path.display().to_string(), sha256: content_hash(&path)? };
            Ok::<_, FileError>(Self(Arc::new(Machine { hexapod, origin })))
        };
        py.detach(read).map_err(|cause| raised(py, &cause.into()))
    }

    /// Read the text of a hexapod.toml that is in no file: messages name keys, not lines. `origin` is kept when there is one.
    #[staticmethod]
    #[pyo3(signature = (text, name, origin=None))]
    fn of_text(py: Python<'_>, text: &str, name: &str, origin: Option<(String, String)>) -> PyResult<Self> {
        let without_line = |cause: FileError| {
            let place = Box::new(cause.place.without_line());
            raised(py, &Failure::File(FileError { place, ..cause }))
        };
        let hexapod = parse_hexapod(text, name).map_err(without_line)?;
        let kept = origin.map(|(name, sha256)| Origin { name, sha256 });
        let origin = kept.unwrap_or_else(|| Origin::in_memory(name, &hexapod_to_toml(&hexapod)));
        Ok(Self(Arc::new(Machine { hexapod, origin })))
    }

    /// Name and SHA-256 of the file it comes from, or of the one that would be written.
    #[getter]
    fn origin(&self) -> (String, String) {
        self.0.origin.pair()
    }

    /// What reports call the machine.
    #[getter]
    fn name(&self) -> &str {
        &self.0.hexapod.name
    }

    /// Base joints, fixed frame, (6, 3).
    #[getter]
    fn base_joints_mm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        millimetres(py, &self.0.hexapod.base_joints)
    }

    /// Platform joints, mobile frame, (6, 3).
    #[getter]
    fn platform_joints_mm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        millimetres(py, &self.0.hexapod.platform_joints)
    }

    /// Standard deviation of one reading of a translation.
    #[getter]
    fn sigma_translation_um(&self) -> Option<f64> {
        self.0.hexapod.metrology.map(|m| m.sigma_translation * 1e6)
    }

    /// Standard deviation of one reading of a rotation.
    #[getter]
    fn sigma_rotation_urad(&self) -> Option<f64> {
        self.0.hexapod.metrology.map(|m| m.sigma_rotation * 1e6)
    }

    /// The text of hexapod.toml.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        refuse_in_file(py, &self.0.hexapod)?;
        Ok(self.described())
    }

    /// All that is stated, a sensor of one's own by its name.
    fn described(&self) -> String {
        hexapod_to_toml(&self.0.hexapod)
    }

    /// True for a machine of which the same is stated.
    fn is_like(&self, other: &Self) -> bool {
        self.described() == other.described() && share_functions(&self.0.hexapod, &other.0.hexapod)
    }

    /// The machine with one more sensor, a function of the transform of the platform, (4, 4), mm.
    fn with_sensor(
        &self,
        py: Python<'_>,
        name: &str,
        function: Py<PyAny>,
        sigma: f64,
        is_angle: bool,
    ) -> PyResult<Self> {
        let hexapod = with_sensor(py, &self.0.hexapod, name, function, sigma, is_angle)?;
        Ok(Self::of(hexapod, &self.0.origin.name))
    }
}

impl PyHexapod {
    /// A machine that is in no file.
    pub(crate) fn of(hexapod: Hexapod, name: &str) -> Self {
        let origin = Origin::in_memory(name, &hexapod_to_toml(&hexapod));
        Self(Arc::new(Machine { hexapod, origin }))
    }
}

fn millimetres<'py>(py: Python<'py>, joints: &[Vector3; 6]) -> Bound<'py, PyArray2<f64>> {
    let unit = unit_named("mm", Dimension::Length);
    let in_mm = |m: f64| unit.map_or(m, |unit| unit.from_si(m));
    rows(py, joints.iter().map(|joint| [in_mm(joint.x), in_mm(joint.y), in_mm(joint.z)]))
}

/// Write a text whole or not at all.
#[pyfunction]
pub(crate) fn write_text(py: Python<'_>, path: PathBuf, text: &str) -> PyResult<()> {
    let write = || atomic_write(&path, |out| out.write_all(text.as_bytes()));
    py.detach(write).map_err(|cause| raised(py, &Failure::unwritable(&path)(cause)))
}
