//! The virtual bench.

use std::path::PathBuf;

use hexbench_app::simulate::{Choices, scene};
use hexbench_truth::scene::{Existing, VirtualBench};
use pyo3::prelude::*;

use crate::run::beside;

/// How a scene is measured.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    seed: Option<u64>,
    poses: Option<u64>,
    repeats: Option<u64>,
    noise_free: bool,
    force: bool,
}

/// Measure a scene and write the folder that the command writes.
#[pyfunction]
pub(crate) fn simulate(py: Python<'_>, folder: PathBuf, output: PathBuf, wanted: Wanted) -> PyResult<()> {
    beside(py, move || {
        let Wanted { seed, poses, repeats, noise_free, force } = wanted;
        let scene = scene(&folder, Choices { seed, poses, repeats, balls: false })?;
        let existing = if force { Existing::Replaced } else { Existing::Refused };
        Ok(VirtualBench::new(&scene, noise_free).write(&output, existing, &|_| ())?)
    })
}
