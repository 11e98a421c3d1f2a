//! Sweeps: how a study divides, one part of it, all parts together.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use hexbench_app::Failure;
use hexbench_experiments::harness::{ExperimentPart, Silent};
use hexbench_experiments::journal::Adopted;
use hexbench_experiments::sweep::cells::AxisLevel;
use hexbench_experiments::sweep::columns::Status;
use hexbench_experiments::sweep::task::open::{OpenTrial, OpenTrials};
use hexbench_experiments::sweep::{Runner, SweepStudy, Work, divide, page};
use hexbench_report::render::plain;
use pyo3::prelude::*;
use serde_json::json;

use crate::campaign::PyCampaign;
use crate::error::usage;
use crate::json::loaded;
use crate::machine::PyHexapod;
use crate::run::{beside, threads};

/// Shards that each thread computes before Ctrl-C is looked for.
const SHARDS_PER_THREAD: usize = 4;

/// How a study divides into parts.
#[pyfunction]
pub(crate) fn study_plan(py: Python<'_>, study: PathBuf, parts: u64) -> PyResult<Bound<'_, PyAny>> {
    if ExperimentPart::new(1, parts).is_none() {
        return Err(usage(py, &format!("{parts} parts: there must be one or more, and at most 100000"), ""));
    }
    loaded(py, &beside(py, move || Ok(divide(&study, parts)?))?)
}

/// Computes what is missing of a part.
#[pyfunction]
pub(crate) fn study_run_part<'py>(
    py: Python<'py>,
    study: PathBuf,
    part: &str,
    folder: PathBuf,
) -> PyResult<Bound<'py, PyAny>> {
    let part: ExperimentPart =
        part.parse().map_err(|cause| usage(py, &format!("part \"{part}\": {cause}"), ""))?;
    let place = folder.display().to_string();
    let work = beside(py, move || Ok(Arc::new(Work::open(&study, &folder)?)))?;
    let next = || {
        let work = Arc::clone(&work);
        beside(py, move || Ok(work.todo(Some(part))?))
    };
    let mut todo = next()?;
    let (damaged, mut shards, mut trials) = (todo.damaged, 0, 0);
    // Where cells stop when they are decided, one round follows another.
    while !todo.pending.is_empty() {
        for some in todo.pending.chunks(SHARDS_PER_THREAD * threads(py)?) {
            let (work, some) = (Arc::clone(&work), some.to_vec());
            beside(py, move || Ok(work.compute(&some, &Silent)?))?;
            py.check_signals()?;
        }
        shards += todo.pending.len();
        trials += todo.pending_trials;
        todo = next()?;
    }
    loaded(
        py,
        &json!({
            "part": part.to_string(),
            "folder": place,
            "trials": todo.trials,
            "computed_shards": shards,
            "computed_trials": trials,
            "damaged": damaged,
        }),
    )
}

/// The trials of a study, for an algorithm of Python.
#[pyclass(frozen, module = "hexbench._native")]
pub(crate) struct StudyTrials(Arc<OpenTrials>);

/// Machine, readings to learn from, to judge by, the same without noise; true stiffness, N/um; hidden effects, the size of one alone.
type Opened = (PyHexapod, PyCampaign, PyCampaign, PyCampaign, [f64; 6], Vec<&'static str>, Option<f64>);

#[pymethods]
impl StudyTrials {
    #[new]
    fn new(py: Python<'_>, study: PathBuf) -> PyResult<Self> {
        let runner = beside(py, move || Ok(Runner::new(SweepStudy::read(&study)?)?))?;
        Ok(Self(Arc::new(OpenTrials::of(runner))))
    }

    /// Trials of each cell.
    #[getter]
    fn trials(&self) -> u64 {
        self.0.runner().study().trials
    }

    /// Of every cell, the value on each axis that the study gives.
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let axes = &self.0.runner().study().axes;
        let levels = axes.levels();
        let cell = |index: usize| {
            let given = levels.iter().zip(axes.cell(index).position).filter(|(axis, _)| axis.given);
            let value = |level: &AxisLevel| match level {
                AxisLevel::Number(x) => json!(x),
                AxisLevel::Word(word) => json!(word),
            };
            let named = given.map(|(axis, at)| (axis.name.to_owned(), value(&axis.levels[at])));
            serde_json::Value::Object(named.collect())
        };
        loaded(py, &(0..axes.cells()).map(cell).collect::<Vec<_>>())
    }

    /// What became of a trial of a cell: `done`, or the reason why it has no readings.
    fn trial(&self, py: Python<'_>, cell: usize, trial: u64) -> PyResult<(&'static str, Option<Opened>)> {
        let study = self.0.runner().study();
        if cell >= study.axes.cells() || trial >= study.trials {
            let all = format!("the study has {} cells of {} trials", study.axes.cells(), study.trials);
            return Err(usage(py, &format!("trial {trial} of cell {cell}: {all}"), "Both count from 0."));
        }
        let all = Arc::clone(&self.0);
        let opened = beside(py, move || Ok(all.trial(cell, trial)))?;
        let handed = |open: OpenTrial| {
            let machine = PyHexapod::of(open.hexapod, "hexapod.toml");
            let [measured, held, ideal] = [open.measurements, open.holdout, open.ideal]
                .map(|data| PyCampaign::simulated(&machine, data));
            let stiffness = open.true_stiffness.map(|k| k * 1e-6);
            (machine, measured, held, ideal, stiffness, open.hidden, open.true_size)
        };
        let status = opened.as_ref().err().copied().unwrap_or(Status::Done);
        Ok((Status::NAMES[status as usize], opened.ok().map(handed)))
    }
}

/// The folder of a study that takes records from elsewhere, in use by this object alone until it is closed.
#[pyclass(frozen, module = "hexbench._native")]
pub(crate) struct StudyWork {
    /// None when it is closed.
    work: Mutex<Option<Arc<Work>>>,
}

impl StudyWork {
    fn open(&self, py: Python<'_>) -> PyResult<Arc<Work>> {
        let work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        work.clone().ok_or_else(|| usage(py, "the folder is closed", ""))
    }
}

#[pymethods]
impl StudyWork {
    #[new]
    fn new(py: Python<'_>, study: PathBuf, folder: PathBuf) -> PyResult<Self> {
        let work = beside(py, move || Ok(Work::open(&study, &folder)?))?;
        Ok(Self { work: Mutex::new(Some(Arc::new(work))) })
    }

    /// Lets the folder go, for other runs.
    fn close(&self) {
        self.work.lock().unwrap_or_else(PoisonError::into_inner).take();
    }

    /// What the whole is, and what of it is still to do.
    fn todo<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let work = self.open(py)?;
        let (shards, files) = (work.shards().count(), work.study().files.clone());
        let todo = beside(py, move || Ok(work.todo(None)?))?;
        loaded(
            py,
            &json!({
                "shards": shards,
                "files": files,
                "trials": todo.trials,
                "pending_shards": todo.pending,
                "pending_trials": todo.pending_trials,
                "damaged": todo.damaged,
            }),
        )
    }

    /// Keeps the record of a shard.
    fn keep(&self, py: Python<'_>, shard: u64, record: &[u8]) -> PyResult<()> {
        let (work, record) = (self.open(py)?, record.to_vec());
        beside(py, move || Ok(work.journal().keep_record(shard, &record)?))
    }

    /// Writes the results of a study that is complete.
    fn write(&self, py: Python<'_>, markdown: Option<PathBuf>) -> PyResult<Py<PyAny>> {
        let work = self.open(py)?;
        let found = beside(py, move || results(&work, markdown.as_deref()))?;
        Ok(loaded(py, &found)?.unbind())
    }
}

/// Writes the results of a study that is complete, and tells where they are and what they say.
fn results(work: &Work, markdown: Option<&Path>) -> Result<serde_json::Value, Failure> {
    work.require_complete()?;
    let cells = work.write_tables(&|| ())?;
    page::write(work.study(), &cells, work.folder(), markdown)?;
    Ok(json!({
        "folder": work.folder(),
        "shards": work.shards().count(),
        "written": work.written(),
        "summary": plain(&page::summary(work.study(), &cells)),
    }))
}

/// Puts parts together and writes the results.
#[pyfunction]
#[pyo3(signature = (study, parts, folder, markdown=None))]
pub(crate) fn study_merge(
    py: Python<'_>,
    study: PathBuf,
    parts: Vec<PathBuf>,
    folder: PathBuf,
    markdown: Option<PathBuf>,
) -> PyResult<Bound<'_, PyAny>> {
    let found = beside(py, move || {
        let work = Work::open(&study, &folder)?;
        let mut all = Adopted::default();
        for part in &parts {
            let Adopted { taken, known, damaged } = work.journal().adopt(part)?;
            all = Adopted {
                taken: all.taken + taken,
                known: all.known + known,
                damaged: all.damaged + damaged,
            };
        }
        let mut found = results(&work, markdown.as_deref())?;
        for (key, shards) in [("taken", all.taken), ("known", all.known), ("damaged", all.damaged)] {
            found[key] = shards.into();
        }
        Ok::<_, Failure>(found)
    })?;
    loaded(py, &found)
}
