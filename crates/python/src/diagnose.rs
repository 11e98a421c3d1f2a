//! Comparisons and diagnoses.

use std::fmt::Display;
use std::str::FromStr;
use std::sync::Arc;

use hexbench_app::{Failure, input};
use hexbench_core::Dataset;
use hexbench_model::effects::term::Term;
use hexbench_model::inference::misread::names;
use hexbench_model::results::compare::{ComparedModel, compare as compared_with};
use hexbench_model::results::diagnose::{DiagnoseOptions, DiagnosisStudy, diagnose_with};
use hexbench_model::results::discover::{DiscoveryStudy, diagnose_with_proposal, discover as search_law};
use hexbench_model::results::runs::{Origin, WithOrigin};
use hexbench_report::Page;
use hexbench_report::charts::{self, ReportError};
use hexbench_report::render::{PROGRAM, Terminal, html, plain, terminal};
use hexbench_report::words::{self, LawFiles, Provenance, ReportSubject, as_option, files_asked, subject};
use pyo3::prelude::*;
use serde::Serialize;

use crate::campaign::{Measured, PyCampaign};
use crate::error::internal;
use crate::model::PyModel;
use crate::own_term::{OwnTerm, own_terms};
use crate::run::beside;

/// What a result is about.
struct About {
    measured: Arc<Measured>,
    holdout: Option<Arc<Measured>>,
}

impl About {
    fn of(campaign: &PyCampaign, holdout: Option<&PyCampaign>) -> Self {
        Self { measured: Arc::clone(&campaign.0), holdout: holdout.map(|h| Arc::clone(&h.0)) }
    }

    fn held(&self) -> Option<&Dataset> {
        self.holdout.as_ref().map(|h| &h.data)
    }

    fn subject<'a>(&'a self, study: &'a DiagnosisStudy) -> ReportSubject<'a> {
        ReportSubject::of(&self.measured.machine.hexapod, &self.measured.data, self.held(), study)
    }

    fn failure(&self, cause: hexbench_model::error::ModelError) -> Failure {
        Failure::of_model(&self.measured.data.source)(cause)
    }

    /// The result as the command writes it.
    fn json(&self, py: Python<'_>, result: &impl Serialize) -> PyResult<String> {
        let machine = &self.measured.machine;
        let run = Origin::new(
            PROGRAM,
            (&machine.hexapod, machine.origin.sha256.clone()),
            (&self.measured.data, self.measured.origin.sha256.clone()),
            self.holdout.as_ref().map(|h| h.origin.sha256.clone()),
        );
        let text = serde_json::to_string_pretty(&WithOrigin { result, run });
        text.map(|text| text + "\n").map_err(|cause| internal(py, &cause.to_string()))
    }

    fn provenance(&self, function: &str) -> Provenance {
        let read = [Some(&self.measured.machine.origin), Some(&self.measured.origin)];
        let held = self.holdout.as_ref().map(|h| &h.origin);
        let files = read.into_iter().chain([held]).flatten();
        Provenance {
            command: format!("hexbench.{function} in Python"),
            files: files.map(|origin| (origin.name.clone(), origin.sha256.clone())).collect(),
        }
    }
}

fn page_text(page: &Page) -> Result<String, Failure> {
    Ok(html(page).map_err(ReportError::from)?)
}

/// A diagnosis.
#[pyclass(frozen, name = "Diagnosis", module = "hexbench._native")]
pub(crate) struct PyDiagnosis(Arc<(About, DiagnosisStudy)>);

#[pymethods]
impl PyDiagnosis {
    /// The text of diagnosis.json.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.0.json(py, &self.0.1.diagnosis)
    }

    /// The page of the command.
    fn text(&self, verbose: bool) -> String {
        let (about, study) = self.0.as_ref();
        terminal(&words::diagnosis(&about.subject(study)), Terminal { verbose, ..Terminal::default() })
    }

    /// The page for a browser.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        let both = Arc::clone(&self.0);
        beside(py, move || {
            let (about, study) = both.as_ref();
            page_text(&charts::diagnosis(&about.subject(study), &about.provenance("diagnose"))?)
        })
    }
}

/// Name the physical effect the model lacks.
#[pyfunction]
pub(crate) fn diagnose(
    py: Python<'_>,
    campaign: &PyCampaign,
    holdout: Option<&PyCampaign>,
    terms: Vec<OwnTerm>,
    exclude: Vec<String>,
    keep_all: bool,
    read_as: Vec<String>,
) -> PyResult<PyDiagnosis> {
    let about = About::of(campaign, holdout);
    beside(py, move || {
        let all = input::catalogue_with(&own_terms(&terms)?);
        let options = options(&exclude, keep_all, &read_as)?;
        let Measured { machine, data, .. } = about.measured.as_ref();
        let study = diagnose_with_proposal(&machine.hexapod, data, about.held(), &all, &options);
        let study = study.map_err(|cause| about.failure(cause))?;
        Ok(PyDiagnosis(Arc::new((about, study))))
    })
}

/// A search for laws, and what it was asked.
struct Searched {
    about: About,
    terms: Vec<Arc<dyn Term>>,
    options: DiagnoseOptions,
    study: DiscoveryStudy,
}

impl Searched {
    /// What the next commands name.
    fn files(&self) -> LawFiles {
        let Measured { machine, origin, .. } = self.about.measured.as_ref();
        let held = self.about.holdout.as_ref().map(|held| &held.origin.name);
        let mut asked = files_asked(&machine.origin.name, &origin.name, held);
        asked.extend(names(&self.options.read_as).iter().map(|change| as_option("read-as", change)));
        let left_out = self.options.exclude.iter().map(|lines| format!("--exclude {lines}")).collect();
        LawFiles { asked, left_out, ..LawFiles::default() }
    }
}

/// A search for laws that no catalogue lists.
#[pyclass(frozen, name = "Discovery", module = "hexbench._native")]
pub(crate) struct PyDiscovery(Arc<Searched>);

#[pymethods]
impl PyDiscovery {
    /// The text of discovery.json.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.about.json(py, &self.0.study.discovery)
    }

    /// The page of the command.
    fn text(&self, verbose: bool) -> String {
        let Searched { about, study, .. } = self.0.as_ref();
        let subject = about.subject(&study.diagnosis);
        let files = self.0.files();
        let page = words::discovery(subject.hexapod, subject.data, subject.holdout, study, &files);
        terminal(&page, Terminal { verbose, ..Terminal::default() })
    }

    /// The page for a browser: the readings as the law explains them.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        let searched = Arc::clone(&self.0);
        beside(py, move || {
            let Searched { about, terms, options, study } = searched.as_ref();
            let Measured { machine, data, .. } = about.measured.as_ref();
            let competing = study.competing(terms);
            let with_law = diagnose_with(&machine.hexapod, data, about.held(), &competing, options);
            let with_law = with_law.map_err(|cause| about.failure(cause))?;
            let provenance = about.provenance("discover");
            let files = searched.files();
            page_text(&charts::discovery(&about.subject(&with_law), study, &files, &provenance)?)
        })
    }

    /// The best law as a term file, where one was found.
    fn term(&self) -> Option<String> {
        self.0.study.term_file().map(str::to_owned)
    }
}

/// Search the law that no catalogue has.
#[pyfunction]
pub(crate) fn discover(
    py: Python<'_>,
    campaign: &PyCampaign,
    holdout: Option<&PyCampaign>,
    terms: Vec<OwnTerm>,
    exclude: Vec<String>,
    read_as: Vec<String>,
) -> PyResult<PyDiscovery> {
    let about = About::of(campaign, holdout);
    beside(py, move || {
        let terms = input::catalogue_with(&own_terms(&terms)?);
        let options = options(&exclude, false, &read_as)?;
        let measured = &about.measured;
        let study = search_law(&measured.machine.hexapod, &measured.data, about.held(), &terms, &options);
        let study = study.map_err(|cause| about.failure(cause))?;
        Ok(PyDiscovery(Arc::new(Searched { about, terms, options, study })))
    })
}

/// How readings are treated, as the arguments say.
fn options(exclude: &[String], keep_all: bool, read_as: &[String]) -> Result<DiagnoseOptions, Failure> {
    Ok(DiagnoseOptions {
        exclude: parsed("exclude", exclude)?,
        keep_all,
        read_as: parsed("read_as", read_as)?,
    })
}

/// Every text as what it says: `12-15` of `exclude`, `deflection-sign=reversed` of `read_as`.
fn parsed<T: FromStr<Err: Display>>(argument: &str, texts: &[String]) -> Result<Vec<T>, Failure> {
    let refused = |cause| Failure::usage(format!("{argument}: {cause}"), String::new());
    texts.iter().map(|text| text.parse().map_err(refused)).collect()
}

/// A comparison.
#[pyclass(frozen, name = "Comparison", module = "hexbench._native")]
pub(crate) struct PyComparison(Arc<(About, ComparedModel)>);

#[pymethods]
impl PyComparison {
    /// The text of comparison.json.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.0.json(py, &self.0.1.comparison)
    }

    /// The page of the command.
    fn text(&self) -> String {
        let (About { measured, holdout }, compared) = self.0.as_ref();
        let held = holdout.as_ref().map(|h| &h.data);
        let about = subject::entries(&measured.data, held, &compared.campaign);
        plain(&words::comparison(&measured.machine.hexapod.name, about, &compared.comparison))
    }

    /// The page for a browser.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        let both = Arc::clone(&self.0);
        beside(py, move || {
            let (about, compared) = both.as_ref();
            let Measured { machine, data, .. } = about.measured.as_ref();
            let held = about.held();
            page_text(&charts::comparison(
                &machine.hexapod,
                data,
                held,
                compared,
                &about.provenance("compare"),
            )?)
        })
    }
}

/// Compare a model, or springs fitted to the data, with measurements.
#[pyfunction]
pub(crate) fn compare(
    py: Python<'_>,
    campaign: &PyCampaign,
    model: Option<&PyModel>,
    holdout: Option<&PyCampaign>,
) -> PyResult<PyComparison> {
    let about = About::of(campaign, holdout);
    let model = model.map(|m| Arc::clone(&m.model));
    beside(py, move || {
        let held = about.held();
        let compared =
            compared_with(&about.measured.machine.hexapod, &about.measured.data, model.as_deref(), held);
        let compared = compared.map_err(|cause| about.failure(cause))?;
        Ok(PyComparison(Arc::new((about, compared))))
    })
}
