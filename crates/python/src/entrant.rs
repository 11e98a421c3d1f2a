//! A Python function as an entrant of a challenge, and guarded by a gate.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use hexbench_app::{Exit, Failure};
use hexbench_cli::{GateFunction, gate_of};
use hexbench_experiments::challenge::run::{Entrant, InsideFunction, Program, RunLimits, run_inside};
use hexbench_experiments::challenge::{Challenge, ChallengeError};
use pyo3::prelude::*;

use crate::error::raised;

/// Cases answered, each failure with its case and reason, cases answered before.
type Answered = (usize, Vec<(String, String)>, usize);

/// A function with what its answers are bound to.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Own {
    function: Py<PyAny>,
    /// What it is called.
    called: String,
    /// Files that it is made of.
    files: Vec<PathBuf>,
    /// What it is made of beside files, each under a name.
    sources: Vec<(String, String)>,
}

impl Own {
    fn program(&self) -> Result<Program, ChallengeError> {
        Program::inside(&self.called, &self.sources).with_depends(&self.files)
    }

    /// Runs work that calls the function with the folder of a case and the folder for the answer.
    fn at_work<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(InsideFunction<'_>) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        // Ctrl-C and the end of the interpreter end the run; any other exception is a failure of one case.
        let ended: Mutex<Option<PyErr>> = Mutex::new(None);
        let stopped = || ended.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = |case: &Path, answer: &Path| {
            Python::attach(|py| {
                self.function.call1(py, (case, answer)).map(|_| ()).map_err(|wrong| {
                    let said = wrong.to_string();
                    if !wrong.is_instance_of::<pyo3::exceptions::PyException>(py) {
                        *stopped() = Some(wrong);
                    }
                    said
                })
            })
        };
        let is_stopped = || stopped().is_some();
        let result = py.detach(|| work(InsideFunction { answer: &answer, is_stopped: &is_stopped }));
        if let Some(wrong) = stopped().take() {
            return Err(wrong);
        }
        result.map_err(|failure| raised(py, &failure))
    }
}

/// Lets a function answer the cases it has not answered.
#[pyfunction]
pub(crate) fn challenge_run_inside(
    py: Python<'_>,
    challenge: PathBuf,
    out: PathBuf,
    name: String,
    again: bool,
    own: Own,
) -> PyResult<Answered> {
    let summary = own.at_work(py, |function| {
        let entrant = Entrant { name, program: own.program()?, limits: RunLimits::NONE };
        Ok(run_inside(&Challenge::open(&challenge)?, &entrant, &out, again, &|_| true, function)?)
    })?;
    let failures = summary.fresh.iter().filter_map(|r| Some((r.case.clone(), r.failure.clone()?)));
    let failures: Vec<_> = failures.collect();
    Ok((summary.fresh.len() - failures.len(), failures, summary.known))
}

/// Guards the scores of a function: the words of `gate record` or `gate check`; what the command wrote, and whether it passed.
#[pyfunction]
pub(crate) fn gate(py: Python<'_>, words: Vec<OsString>, own: Own) -> PyResult<(String, bool)> {
    own.at_work(py, |function| {
        let told = gate_of(words, &GateFunction { program: own.program()?, function });
        match told.end {
            Ok(()) => Ok((told.text, true)),
            Err(failure) if matches!(failure.exit(), Exit::CheckFailed) => Ok((told.text, false)),
            Err(failure) => Err(failure),
        }
    })
}
