//! Sessions of the workbench.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::fit::{fitted, model};
use hexbench_app::session::SessionFile;
use hexbench_model::application::model_file::Estimator;
use hexbench_model::inference::misread::AsMeant;
use hexbench_model::inference::selection::JudgedTask;
use hexbench_report::render::plain;
use hexbench_report::words::{PlusMinus, fitted as page, session};
use pyo3::prelude::*;

use crate::campaign::PyCampaign;
use crate::error::raised;
use crate::model::PyModel;
use crate::run::beside;

/// A session.
#[pyclass(frozen, name = "Session", module = "hexbench._native")]
pub(crate) struct PySession(Arc<SessionFile>);

/// Terms, formulas of one's own, lines left out, error as a multiple of the noise.
type Step = (Vec<String>, Vec<String>, Vec<u64>, f64);

#[pymethods]
impl PySession {
    /// Read session.json.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let file = py.detach(|| SessionFile::read(&path)).map_err(|failure| raised(py, &failure))?;
        Ok(Self(Arc::new(file)))
    }

    /// Program that wrote it.
    #[getter]
    fn program(&self) -> &str {
        &self.0.session.program
    }

    /// Name and SHA-256 of the files it was made with.
    #[getter]
    fn inputs(&self) -> Vec<(String, String)> {
        self.0.session.inputs.iter().map(|input| (input.file.clone(), input.sha256.clone())).collect()
    }

    /// How it reads the files differently from what they say.
    #[getter]
    fn read_as(&self) -> Vec<String> {
        self.0.session.read_as.clone()
    }

    /// Every step.
    #[getter]
    fn steps(&self) -> Vec<Step> {
        let steps = self.0.session.steps.iter();
        steps
            .map(|step| {
                let of = step.selection.clone();
                (of.terms, of.own, of.exclude, step.times_noise)
            })
            .collect()
    }

    /// The step shown, from zero.
    #[getter]
    fn at(&self) -> usize {
        self.0.session.at
    }

    /// What somebody wrote beside it.
    #[getter]
    fn notes(&self) -> &str {
        &self.0.session.notes
    }

    /// The model it shows, fitted to the readings it was made with.
    fn fit(&self, py: Python<'_>, campaign: &PyCampaign, holdout: Option<&PyCampaign>) -> PyResult<PyModel> {
        let file = Arc::clone(&self.0);
        let measured = Arc::clone(&campaign.0);
        let holdout = holdout.map(|h| Arc::clone(&h.0));
        beside(py, move || {
            let machine = &measured.machine;
            let origins =
                [Some(&machine.origin), Some(&measured.origin), holdout.as_ref().map(|h| &h.origin)];
            let digests: Vec<String> = origins.into_iter().flatten().map(|o| o.sha256.clone()).collect();
            file.refuse_others(&digests)?;
            let held = holdout.as_ref().map(|h| &h.data);
            let meant = AsMeant::of(&machine.hexapod, &measured.data, held, &file.session.changes());
            let (hexapod, held) = (&*meant.hexapod, meant.holdout.as_deref());
            let asked = file.to_fit(hexapod, &meant.data)?;
            let task = JudgedTask { hexapod, data: &asked.data, campaign: &asked.campaign, holdout: held };
            let judged = fitted(&task, &asked.added, Estimator::Gls)?;
            let page = page::page(&task, &judged, Estimator::Gls, PlusMinus::Standard);
            let mut made = model(&task, &judged, Estimator::Gls, measured.origin.sha256.clone());
            made.data.read_as.clone_from(&file.session.read_as);
            made.data.excluded.clone_from(&asked.exclude);
            Ok(PyModel::of(made, plain(&page.with(session::left_out(&asked.exclude)))))
        })
    }
}
