//! Sensors of one's own: functions written in Python.

use std::panic::resume_unwind;

use hexbench_app::Failure;
use hexbench_core::files::{hexapod_to_toml, parse_hexapod};
use hexbench_core::{Hexapod, Pose, PoseFunction, Remembered, Sensor, SensorKind};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;

use crate::error::{raised, usage};

/// A function of Python and what it has said: a diagnosis comes back to the same poses again and again.
struct Remembering {
    function: Py<PyAny>,
    known: Remembered<[u64; 6], f64>,
}

/// The machine with one more sensor. `function`: of the transform of the platform, to um, or to urad for an angle; `sigma` likewise.
pub(crate) fn with_sensor(
    py: Python<'_>,
    hexapod: &Hexapod,
    name: &str,
    function: Py<PyAny>,
    sigma: f64,
    is_angle: bool,
) -> PyResult<Hexapod> {
    let sigma = sigma * 1e-6;
    refuse(py, hexapod, name, sigma)?;
    value(py, &function, &Pose::default())?;
    let remembering = Remembering { function, known: Remembered::default() };
    // An exception goes through the computation to the caller, as a panic does.
    let called = move |poses: &[Pose]| {
        remembering.values(poses).unwrap_or_else(|wrong| resume_unwind(Box::new(wrong)))
    };
    let kind = SensorKind::Function { of: PoseFunction::of_many(called), is_angle, sigma };
    let mut hexapod = hexapod.clone();
    hexapod.sensors.push(Sensor::new(name, kind));
    Ok(hexapod)
}

impl Remembering {
    /// Values at these poses, m or rad; Python is asked for those alone that are not known.
    fn values(&self, poses: &[Pose]) -> PyResult<Vec<f64>> {
        let questions: Vec<[u64; 6]> = poses.iter().map(|pose| pose.bits()).collect();
        let known = self.known.get_all(&questions);
        if let Some(all) = known.iter().copied().collect() {
            return Ok(all);
        }
        // Nothing is locked meanwhile: Python may wait for what another thread holds.
        let all = Python::attach(|py| {
            let of = |(pose, known): (&Pose, &Option<f64>)| {
                known.map_or_else(|| value(py, &self.function, pose), Ok)
            };
            poses.iter().zip(&known).map(of).collect::<PyResult<Vec<f64>>>()
        })?;
        self.known.keep(questions.into_iter().zip(all.iter().copied()));
        Ok(all)
    }
}

/// What the rules of hexapod.toml have against a sensor of this name, m or rad: they are asked with scales in the place of functions.
fn refuse(py: Python<'_>, hexapod: &Hexapod, name: &str, sigma: f64) -> PyResult<()> {
    let mut written = hexapod.clone();
    written.sensors.push(Sensor::new(name, SensorKind::LegLength { leg: 0, sigma }));
    for sensor in written.sensors.iter_mut().filter(|s| is_function(s)) {
        sensor.kind = SensorKind::LegLength { leg: 0, sigma: sensor.kind.sigma(0) };
    }
    let read = parse_hexapod(&hexapod_to_toml(&written), "hexapod");
    read.map(|_| ()).map_err(|cause| raised(py, &Failure::File(cause)))
}

/// m or rad.
fn value(py: Python<'_>, function: &Py<PyAny>, pose: &Pose) -> PyResult<f64> {
    let micro: f64 = function.call1(py, (transform(py, pose),))?.extract(py)?;
    if micro.is_finite() {
        return Ok(micro * 1e-6);
    }
    Err(usage(
        py,
        &format!("the function of a sensor returned {micro}"),
        "It must return a number for every pose of the campaign.",
    ))
}

/// Takes a point of the mobile frame to the fixed frame: (4, 4), mm.
fn transform<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, PyArray2<f64>> {
    let mut all = Array2::eye(4);
    let rotation = pose.rotation();
    for i in 0..3 {
        (0..3).for_each(|j| all[(i, j)] = rotation[(i, j)]);
        all[(i, 3)] = pose.translation[i] * 1e3;
    }
    all.into_pyarray(py)
}

fn is_function(sensor: &Sensor) -> bool {
    matches!(sensor.kind, SensorKind::Function { .. })
}

/// True for machines whose functions are the same ones.
pub(crate) fn share_functions(a: &Hexapod, b: &Hexapod) -> bool {
    let functions = |h: &Hexapod| h.sensors.iter().filter(|s| is_function(s)).cloned().collect::<Vec<_>>();
    functions(a) == functions(b)
}

/// # Errors
/// No file holds a function.
pub(crate) fn refuse_in_file(py: Python<'_>, hexapod: &Hexapod) -> PyResult<()> {
    hexapod.sensors.iter().find(|s| is_function(s)).map_or(Ok(()), |sensor| {
        Err(usage(
            py,
            &format!("the sensor {} is a Python function, which files cannot contain", sensor.name),
            "Save the machine without it, and add it again with Hexapod.with_sensor.",
        ))
    })
}
