//! Fits, models, and what they predict.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hexbench_app::fit::{added, fitted, model as kept};
use hexbench_app::{Failure, input};
use hexbench_core::{Matrix6, Observation, Vector3};
use hexbench_model::application::compensate::{Correction, compensate};
use hexbench_model::application::model_file::{Estimator, Model};
use hexbench_model::application::predict::{
    PredictError, predict_sensors_with_covariance, predict_with_covariance,
};
use hexbench_model::application::stiffness::{
    CartesianStiffness, StiffnessAxes, StiffnessPoint, cartesian_stiffness,
};
use hexbench_model::estimation::estimate::Estimates;
use hexbench_model::estimation::fit_named::asked_as;
use hexbench_model::inference::selection::JudgedTask;
use hexbench_model::results::diagnose::prepare_to_fit;
use hexbench_report::render::plain;
use hexbench_report::words;
use nalgebra::DMatrix;
use numpy::{PyArray2, PyArray3};
use pyo3::prelude::*;

use crate::arrays::{TwoArrays, matrices, matrix, rows};
use crate::blocks::of_row;
use crate::campaign::{PyCampaign, conditions};
use crate::error::{raised, usage};
use crate::machine::PyHexapod;
use crate::own_sensor::refuse_in_file;
use crate::own_term::{OwnTerm, own_terms, refuse_terms_in_file};
use crate::run::beside;

/// A fitted model.
#[pyclass(frozen, name = "Model", module = "hexbench._native")]
pub(crate) struct PyModel {
    pub(crate) model: Arc<Model>,
    estimates: Estimates,
    summary: String,
}

#[pymethods]
impl PyModel {
    /// Read model.toml; with `trust` also one that was changed by hand.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf, trust: bool) -> PyResult<Self> {
        let model = py.detach(|| input::model(&path, trust)).map_err(|failure| raised(py, &failure))?;
        Ok(Self::of(model, String::new()))
    }

    /// Read the text of a model.toml.
    #[staticmethod]
    fn of_text(py: Python<'_>, text: &str, summary: String) -> PyResult<Self> {
        let model = input::model_of(text, Path::new("model")).map_err(|failure| raised(py, &failure))?;
        Ok(Self::of(model, summary))
    }

    /// The text of model.toml.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        refuse_in_file(py, &self.model.hexapod)?;
        refuse_terms_in_file(py, &self.model)?;
        self.model.to_toml().map_err(|cause| raised(py, &Failure::in_file(Path::new("model"))(cause)))
    }

    /// Name, value, standard uncertainty, unit of every number the data determine.
    fn estimates(&self) -> Vec<(String, f64, f64, String)> {
        let all = self.estimates.determined.iter();
        all.map(|e| (e.name.clone(), e.value, e.std, e.unit.clone())).collect()
    }

    /// Values (n, 6) and covariances (n, 6, 6) of conditions given as columns.
    fn predict<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        columns: Vec<Bound<'py, PyAny>>,
    ) -> PyResult<TwoArrays<'py>> {
        let found = self.of_conditions(py, names, &columns, predict_with_covariance)?;
        let absolute = self.model.is_absolute();
        let value = |x: [f64; 6]| -> [f64; 6] {
            std::array::from_fn(|k| match (absolute, k < 3) {
                (false, _) => x[k] * 1e6,
                (true, true) => x[k] * 1e3,
                (true, false) => x[k].to_degrees(),
            })
        };
        let values = rows(py, found.iter().map(|(reading, _)| value(reading.value)));
        Ok((values, matrices(py, [found.len(), 6], |n, i, j| found[n].1[(i, j)] * 1e12)))
    }

    /// Values (n, m) and covariances (n, m, m) of what the sensors read under conditions given as columns, um and urad.
    fn predict_sensors<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        columns: Vec<Bound<'py, PyAny>>,
    ) -> PyResult<TwoArrays<'py>> {
        let found = self.of_conditions(py, names, &columns, predict_sensors_with_covariance)?;
        let shape = [found.len(), self.model.sensor_channels().len()];
        let values = DMatrix::from_fn(shape[0], shape[1], |n, k| found[n].0[k].value * 1e6);
        Ok((matrix(py, &values), matrices(py, shape, |n, i, j| found[n].1[(i, j)] * 1e12)))
    }

    /// Poses to command (mm, deg), what then remains, its standard uncertainty, the error without correction (um, urad): (n, 6) each.
    fn compensate<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        columns: Vec<Bound<'py, PyAny>>,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 4]> {
        let found = self.of_conditions(py, names, &columns, compensate)?;
        let shown = |x: [f64; 6]| -> [f64; 6] {
            std::array::from_fn(|k| if k < 3 { x[k] * 1e3 } else { x[k].to_degrees() })
        };
        let small = |of: fn(&Correction) -> [f64; 6]| rows(py, found.iter().map(|c| of(c).map(|x| x * 1e6)));
        let commands = rows(py, found.iter().map(|c| shown(c.command.to_array())));
        Ok([commands, small(|c| c.remaining), small(|c| c.sigma), small(|c| c.without)])
    }

    /// K, its standard uncertainty, C, its standard uncertainty (n, 6, 6 each, SI) at conditions given as columns; the point in mm.
    fn stiffness<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        columns: Vec<Bound<'py, PyAny>>,
        point: [f64; 3],
        axes: &str,
        amplitude: f64,
    ) -> PyResult<[Bound<'py, PyArray3<f64>>; 4]> {
        let axes = StiffnessAxes::named(axes)
            .ok_or_else(|| usage(py, &format!("axes = {axes:?}"), "Use \"fixed\" or \"mobile\"."))?;
        let point = Vector3::from(point) * 1e-3;
        if !(point.iter().all(|x| x.is_finite()) && amplitude.is_finite() && amplitude > 0.0) {
            let what = "a point that is not finite, or an amplitude that is not positive";
            return Err(usage(py, what, "Use finite numbers: mm and N."));
        }
        let at = StiffnessPoint { point, axes, amplitude };
        let stiffness = move |model: &Model, rows: &[Observation]| cartesian_stiffness(model, rows, &at);
        let found = self.of_conditions(py, names, &columns, stiffness)?;
        let all = |of: fn(&CartesianStiffness) -> &Matrix6| {
            matrices(py, [found.len(), 6], |n, i, j| of(&found[n])[(i, j)])
        };
        Ok([
            all(|k| &k.stiffness),
            all(|k| &k.stiffness_std),
            all(|k| &k.compliance),
            all(|k| &k.compliance_std),
        ])
    }

    /// Names of the columns that the sensors of the machine fill, with units.
    #[getter]
    fn sensor_columns(&self) -> Vec<String> {
        self.model.sensor_columns()
    }

    /// Names of parameters without a number.
    #[getter]
    fn not_determined(&self) -> Vec<String> {
        self.estimates.not_determined.clone()
    }

    /// Covariance, SI, (p, p).
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        matrix(py, &self.model.covariance)
    }

    /// Names of its rows.
    #[getter]
    fn covariance_names(&self) -> Vec<String> {
        self.model.parameters.iter().map(|p| p.name.clone()).collect()
    }

    /// The machine.
    #[getter]
    fn hexapod(&self) -> PyHexapod {
        PyHexapod::of(self.model.hexapod.clone(), "hexapod")
    }

    /// Terms beside the springs.
    #[getter]
    fn terms(&self) -> Vec<String> {
        self.model.point.active.iter().map(|a| asked_as(a.id(), a.rich)).collect()
    }

    /// True for absolute poses.
    #[getter]
    fn absolute(&self) -> bool {
        self.model.is_absolute()
    }

    /// Chi-square of the fit.
    #[getter]
    fn chi2(&self) -> f64 {
        self.model.chi2
    }

    /// Its degrees of freedom.
    #[getter]
    fn degrees_of_freedom(&self) -> f64 {
        self.model.dof
    }

    /// Of a translation (um) and of a rotation (urad).
    #[getter]
    fn noise(&self) -> (f64, f64) {
        (self.model.noise.translation * 1e6, self.model.noise.rotation * 1e6)
    }

    /// Where the noise comes from.
    #[getter]
    fn noise_source(&self) -> &str {
        self.model.noise.source.word()
    }

    /// What the command prints of the fit.
    #[getter]
    fn summary(&self) -> &str {
        &self.summary
    }
}

impl PyModel {
    pub(crate) fn of(model: Model, summary: String) -> Self {
        let estimates = model.estimates();
        Self { model: Arc::new(model), estimates, summary }
    }

    /// What the model says of conditions given as columns.
    fn of_conditions<T: Send + 'static>(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        columns: &[Bound<'_, PyAny>],
        of: impl FnOnce(&Model, &[Observation]) -> Result<T, PredictError> + Send + 'static,
    ) -> PyResult<T> {
        let data = conditions(py, names, columns, "poses")?;
        let model = Arc::clone(&self.model);
        beside(py, move || {
            let found = of(&model, &data.observations);
            found.map_err(|wrong| of_row(wrong.line.saturating_sub(2), wrong.cause))
        })
    }
}

/// Fit springs and the terms that are named.
#[pyfunction]
pub(crate) fn fit(
    py: Python<'_>,
    campaign: &PyCampaign,
    add: Vec<String>,
    holdout: Option<&PyCampaign>,
    terms: Vec<OwnTerm>,
    estimator: &str,
) -> PyResult<PyModel> {
    let Some(estimator) = Estimator::named(estimator) else {
        return Err(usage(
            py,
            &format!("there is no estimator \"{estimator}\""),
            "Use \"gls\" or \"paper\".",
        ));
    };
    let measured = Arc::clone(&campaign.0);
    let holdout = holdout.map(|h| Arc::clone(&h.0));
    beside(py, move || {
        let (hexapod, data) = (&measured.machine.hexapod, &measured.data);
        let added = added(&add, own_terms(&terms)?, estimator)?;
        let failed = Failure::of_model(&data.source);
        let campaign = prepare_to_fit(hexapod, data, &added).map_err(failed)?;
        let task =
            JudgedTask { hexapod, data, campaign: &campaign, holdout: holdout.as_ref().map(|h| &h.data) };
        let judged = fitted(&task, &added, estimator)?;
        let summary = plain(&words::fitted::page(&task, &judged, estimator, words::PlusMinus::Standard));
        let model = kept(&task, &judged, estimator, measured.origin.sha256.clone());
        Ok(PyModel::of(model, summary))
    })
}
