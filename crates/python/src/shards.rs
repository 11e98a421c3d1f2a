//! Experiments by their shards: computed here for a folder elsewhere, or kept here from elsewhere.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use hexbench_app::Failure;
use hexbench_cli::SharedExperiment;
use hexbench_experiments::harness::{Sharded, record};
use hexbench_experiments::journal::Journal;
use hexbench_experiments::sweep::{Runner, SweepStudy};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use serde_json::json;

use crate::error::{internal, usage};
use crate::json::loaded;
use crate::run::beside;

type Work = Arc<dyn Sharded + Send>;

/// An experiment that computes records of its shards, for a folder elsewhere.
#[pyclass(frozen, module = "hexbench._native")]
pub(crate) struct ShardRunner {
    work: Work,
    pool: Arc<ThreadPool>,
}

impl ShardRunner {
    fn ready(
        py: Python<'_>,
        threads: usize,
        read: impl FnOnce() -> Result<Work, Failure> + Send + 'static,
    ) -> PyResult<Self> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = Arc::new(pool.map_err(|cause| internal(py, &cause.to_string()))?);
        let at_work = Arc::clone(&pool);
        Ok(Self { work: beside(py, move || at_work.install(read))?, pool })
    }
}

#[pymethods]
impl ShardRunner {
    /// Of a study.
    #[staticmethod]
    fn of_study(py: Python<'_>, study: PathBuf, threads: usize) -> PyResult<Self> {
        Self::ready(py, threads, move || {
            let runner: Work = Arc::new(Runner::new(SweepStudy::read(&study)?)?);
            Ok(runner)
        })
    }

    /// Of an experiment of a command, with copies of the files that it names.
    #[staticmethod]
    fn of_command(
        py: Python<'_>,
        words: Vec<OsString>,
        files: Vec<PathBuf>,
        which: usize,
        threads: usize,
    ) -> PyResult<Self> {
        Self::ready(py, threads, move || {
            let works = SharedExperiment::of(words)?.with_files(files).works()?;
            let wanted = works.into_iter().nth(which);
            wanted.map(|named| Arc::from(named.work)).ok_or_else(|| {
                Failure::usage(format!("the command has no experiment {which}"), "Experiments count from 0.")
            })
        })
    }

    /// Computes shards and gives the record of each.
    fn run<'py>(&self, py: Python<'py>, shards: Vec<u64>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let all = self.work.shards().count();
        if let Some(strange) = shards.iter().find(|n| **n >= all) {
            let message =
                format!("shard {strange}: the experiment has shards 0 to {}", all.saturating_sub(1));
            return Err(usage(py, &message, ""));
        }
        let (work, pool) = (Arc::clone(&self.work), Arc::clone(&self.pool));
        let one = move |&n: &u64| record(&*work, n);
        let all = move || Ok(pool.install(|| shards.par_iter().map(one).collect::<Result<_, _>>())?);
        let records: Vec<Vec<u8>> = beside(py, all)?;
        Ok(records.iter().map(|bytes| PyBytes::new(py, bytes)).collect())
    }
}

/// The experiments of a command with their journals, in use by this object alone until it is closed.
#[pyclass(frozen, module = "hexbench._native")]
pub(crate) struct ExperimentWork {
    /// Files that the trials depend on.
    files: Vec<PathBuf>,
    /// None when it is closed.
    journals: Mutex<Option<Arc<Vec<Journal>>>>,
}

impl ExperimentWork {
    fn open(&self, py: Python<'_>) -> PyResult<Arc<Vec<Journal>>> {
        let journals = self.journals.lock().unwrap_or_else(PoisonError::into_inner);
        journals.clone().ok_or_else(|| usage(py, "the folder is closed", ""))
    }
}

#[pymethods]
impl ExperimentWork {
    /// The words of the command, `--journal` among them.
    #[new]
    fn new(py: Python<'_>, words: Vec<OsString>) -> PyResult<Self> {
        let (files, journals) = beside(py, move || {
            let mut command = SharedExperiment::of(words)?;
            let mut journals = Vec::new();
            for named in command.works()? {
                let folder = command.journal(&named).ok_or_else(|| {
                    let next = "Name a folder in which the trials are saved.";
                    Failure::usage("there is no journal".to_owned(), next)
                })?;
                journals.push(Journal::open(&folder, named.work.identity(), named.work.shards())?);
            }
            Ok((command.files(), journals))
        })?;
        Ok(Self { files, journals: Mutex::new(Some(Arc::new(journals))) })
    }

    /// Lets the folders go, for other runs.
    fn close(&self) {
        self.journals.lock().unwrap_or_else(PoisonError::into_inner).take();
    }

    /// Files and folders that the trials depend on, as they were typed.
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        self.files.clone()
    }

    /// Of every experiment: all shards, those still to be computed.
    fn todo<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let journals = self.open(py)?;
        let all = beside(py, move || {
            let one = |journal: &Journal| {
                let state = journal.state()?;
                Ok(json!({ "shards": journal.shards().count(), "pending_shards": state.pending }))
            };
            journals.iter().map(one).collect::<Result<Vec<_>, Failure>>()
        })?;
        loaded(py, &all)
    }

    /// Keeps the record of a shard of an experiment.
    fn keep(&self, py: Python<'_>, which: usize, shard: u64, record: &[u8]) -> PyResult<()> {
        let (journals, record) = (self.open(py)?, record.to_vec());
        if which >= journals.len() {
            return Err(usage(py, &format!("the command has no experiment {which}"), ""));
        }
        beside(py, move || Ok(journals[which].keep_record(shard, &record)?))
    }
}
