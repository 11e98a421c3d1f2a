//! A Python function as an entrant of a challenge.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use hexbench_app::Failure;
use hexbench_experiments::challenge::Challenge;
use hexbench_experiments::challenge::run::{Entrant, Manner, Program, RunLimits, run_inside};
use pyo3::prelude::*;

use crate::error::raised;

/// Cases answered, each failure with its case and reason, cases answered before.
type Answered = (usize, Vec<(String, String)>, usize);

/// Lets a function answer the cases it has not answered: it is called with the folder of a case and the folder for the answer.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arguments from Python")]
pub(crate) fn challenge_run_inside(
    py: Python<'_>,
    challenge: PathBuf,
    out: PathBuf,
    name: String,
    called: &str,
    depends: Vec<PathBuf>,
    again: bool,
    function: Py<PyAny>,
) -> PyResult<Answered> {
    // Ctrl-C and the end of the interpreter end the run; any other exception is a failure of one case.
    let ended: Mutex<Option<PyErr>> = Mutex::new(None);
    let stopped = || ended.lock().unwrap_or_else(PoisonError::into_inner);
    let program = Program::inside(called).with_depends(&depends);
    let run = || {
        let entrant = Entrant { name, program: program?, limits: RunLimits::NONE };
        let asked = |case: &Path, answer: &Path| {
            Python::attach(|py| {
                function.call1(py, (case, answer)).map(|_| ()).map_err(|wrong| {
                    let said = wrong.to_string();
                    if !wrong.is_instance_of::<pyo3::exceptions::PyException>(py) {
                        *stopped() = Some(wrong);
                    }
                    said
                })
            })
        };
        let manner = Manner { jobs: 1, again };
        run_inside(&Challenge::open(&challenge)?, &entrant, &out, manner, &asked, &|| stopped().is_some())
    };
    let summary = py.detach(run);
    if let Some(wrong) = stopped().take() {
        return Err(wrong);
    }
    let summary = summary.map_err(|cause| raised(py, &Failure::from(cause)))?;
    let failures = summary.fresh.iter().filter_map(|r| Some((r.case.clone(), r.failure.clone()?)));
    let failures: Vec<_> = failures.collect();
    Ok((summary.fresh.len() - failures.len(), failures, summary.known))
}
