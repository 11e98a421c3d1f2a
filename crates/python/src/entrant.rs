//! A Python function as an entrant of a challenge, and guarded by a gate; functions and programs that other machines run.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use hexbench_app::Failure;
use hexbench_cli::{GateFunction, gate_of};
use hexbench_experiments::challenge::run::{
    Entrant, InsideFunction, Program, ProgramFiles, RunLimits, TravelledAnswer, failures, run_inside,
};
use hexbench_experiments::challenge::{Challenge, ChallengeError};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::raised;
use crate::run::beside;

/// Cases answered, each failure with its case and reason, cases answered before.
type Answered = (usize, Vec<(String, String)>, usize);

/// A function with what its answers are bound to, or a program that others run.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Own {
    /// Called with the folder of a case and the folder for the answer; gives nothing, or an answer from elsewhere.
    function: Py<PyAny>,
    /// Called with all cases and the program before the first.
    begin: Option<Py<PyAny>>,
    /// What it is called.
    called: String,
    /// The program with its arguments, where it is one.
    line: Option<Vec<String>>,
    /// Its limits: s, MB of memory, MB of output.
    limits: (f64, u64, u64),
    /// Files that it is made of, or depends on.
    files: Vec<PathBuf>,
    /// What it is made of beside files, each under a name.
    sources: Vec<(String, String)>,
}

impl Own {
    fn entrant(&self, name: String) -> Result<Entrant, ChallengeError> {
        let (time_s, memory_mb, output_mb) = self.limits;
        let (program, limits) = match &self.line {
            Some(line) => (Program::find(line)?, RunLimits { time_s, memory_mb, output_mb }),
            None => (Program::inside(&self.called, &self.sources), RunLimits::NONE),
        };
        Ok(Entrant { name, program: program.with_depends(&self.files)?, limits })
    }

    /// Runs work that calls the function with the folder of a case and the folder for the answer.
    fn at_work<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(InsideFunction<'_>) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        // Ctrl-C, the end of the interpreter and whatever is wrong elsewhere end the run; any other exception is a failure of one case.
        let ended: Mutex<Option<PyErr>> = Mutex::new(None);
        let stopped = || ended.lock().unwrap_or_else(PoisonError::into_inner);
        let begin = |entrant: &Entrant, cases: &[PathBuf]| {
            let Some(begin) = &self.begin else { return };
            let begun = Python::attach(|py| begin.call1(py, (cases.to_vec(), handed(entrant)?)));
            if let Err(wrong) = begun {
                *stopped() = Some(wrong);
            }
        };
        let answer = |case: &Path, answer: &Path| {
            if stopped().is_some() {
                return Ok(None);
            }
            Python::attach(|py| {
                let said = self.function.call1(py, (case, answer)).and_then(|said| elsewhere(py, &said));
                said.map_err(|wrong| {
                    let said = wrong.to_string();
                    if self.begin.is_some() || !wrong.is_instance_of::<pyo3::exceptions::PyException>(py) {
                        *stopped() = Some(wrong);
                    }
                    said
                })
            })
        };
        let is_stopped = || stopped().is_some();
        let result =
            py.detach(|| work(InsideFunction { begin: &begin, answer: &answer, is_stopped: &is_stopped }));
        if let Some(wrong) = stopped().take() {
            return Err(wrong);
        }
        result.map_err(|failure| raised(py, &failure))
    }
}

/// Program and arguments, what it depends on besides, limits, digest of all its files.
type Handed = (Vec<String>, Vec<PathBuf>, (f64, u64, u64), String);

/// A program as another machine is told of it.
fn handed(entrant: &Entrant) -> PyResult<Handed> {
    let RunLimits { time_s, memory_mb, output_mb } = entrant.limits;
    let files = ProgramFiles::of(&entrant.program).map_err(|cause| PyOSError::new_err(cause.to_string()))?;
    let program = &entrant.program;
    Ok((program.line().to_vec(), program.depends().to_vec(), (time_s, memory_mb, output_mb), files.sha256()))
}

/// The answer that a function brings from another machine.
fn elsewhere(py: Python<'_>, said: &Py<PyAny>) -> PyResult<Option<TravelledAnswer>> {
    if said.is_none(py) {
        return Ok(None);
    }
    let bytes: Vec<u8> = said.extract(py)?;
    Ok(Some(TravelledAnswer::from_bytes(&bytes)?))
}

/// Runs a program over a case, given by the folder of its public files, as a run elsewhere wants it; the answer as bytes.
#[pyfunction]
pub(crate) fn answer_case(
    py: Python<'_>,
    public: PathBuf,
    program: (Vec<String>, Vec<PathBuf>, (f64, u64, u64), String),
) -> PyResult<Bound<'_, PyBytes>> {
    let (line, depends, (time_s, memory_mb, output_mb), sha256) = program;
    let bytes = beside(py, move || {
        let program = Program::find(&line)?.with_depends(&depends)?;
        let here = ProgramFiles::of(&program)?.sha256();
        if here != sha256 {
            let message = format!("the program {} has different files on this machine", line.join(" "));
            let next = "Copy the same files to the same places on every worker.";
            return Err(Failure::usage(message, next));
        }
        let limits = RunLimits { time_s, memory_mb, output_mb };
        let entrant = Entrant { name: String::new(), program, limits };
        let answered = TravelledAnswer::by_program(&entrant, &public).and_then(|answer| answer.to_bytes());
        answered.map_err(Failure::unwritable(&public))
    })?;
    Ok(PyBytes::new(py, &bytes))
}

/// The answer of a function that has written its files into a folder, or what it says of its failure, as bytes.
#[pyfunction]
#[pyo3(signature = (out, said, wall_s))]
pub(crate) fn answer_of_function(
    py: Python<'_>,
    out: PathBuf,
    said: Option<String>,
    wall_s: f64,
) -> PyResult<Bound<'_, PyBytes>> {
    let answer = TravelledAnswer::by_function(&out, said.as_deref(), wall_s)?;
    Ok(PyBytes::new(py, &answer.to_bytes()?))
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
    own.at_work(py, |function| {
        let challenge = Challenge::open(&challenge)?;
        let summary = run_inside(&challenge, &own.entrant(name)?, &out, again, &|_| true, function)?;
        let [earlier, failed] =
            [&summary.earlier, &summary.fresh].map(|records| failures(&challenge, &out, records));
        let (answered, known) = (summary.fresh.len() - failed.len(), summary.earlier.len());
        let all = earlier.into_iter().chain(failed).map(|(case, why)| (case.to_owned(), why));
        Ok((answered, all.collect(), known))
    })
}

/// Guards the scores of a function: the words of `gate record` or `gate check`; what the command wrote, and whether it passed.
#[pyfunction]
pub(crate) fn gate(py: Python<'_>, words: Vec<OsString>, own: Own) -> PyResult<(String, bool)> {
    own.at_work(py, |function| {
        // A program stands in the words.
        let program = if own.line.is_some() { None } else { Some(own.entrant(String::new())?.program) };
        gate_of(words, &GateFunction { program, function })
    })
}
