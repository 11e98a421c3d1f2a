//! Sweeps: how a study divides, one part of it, all parts together.

use std::path::PathBuf;
use std::sync::Arc;

use hexbench_study::{Adopted, Part, Work, divide, page};
use hexbench_tasks::Failure;
use pyo3::prelude::*;
use serde_json::json;

use crate::error::usage;
use crate::json::loaded;
use crate::run::{beside, threads};

/// Shards that each thread computes before Ctrl-C is looked for.
const SHARDS_PER_THREAD: usize = 4;

/// How a study divides into parts.
#[pyfunction]
pub(crate) fn study_plan(py: Python<'_>, study: PathBuf, parts: u64) -> PyResult<Bound<'_, PyAny>> {
    if Part::new(1, parts).is_none() {
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
    let part: Part = part.parse().map_err(|cause| usage(py, &format!("part \"{part}\": {cause}"), ""))?;
    let told = folder.display().to_string();
    let (work, todo) = beside(py, move || {
        let work = Work::open(&study, &folder)?;
        let todo = work.todo(Some(part))?;
        Ok((Arc::new(work), todo))
    })?;
    for some in todo.pending.chunks(SHARDS_PER_THREAD * threads(py)?) {
        let (work, some) = (Arc::clone(&work), some.to_vec());
        beside(py, move || Ok(work.compute(&some, &|_| ())?))?;
        py.check_signals()?;
    }
    loaded(
        py,
        &json!({
            "part": part.to_string(),
            "folder": told,
            "trials": todo.trials,
            "computed_shards": todo.pending.len(),
            "computed_trials": todo.pending_trials,
            "damaged": todo.damaged,
        }),
    )
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
    let told = beside(py, move || {
        let work = Work::open(&study, &folder)?;
        let mut all = Adopted::default();
        for part in &parts {
            let Adopted { taken, known, damaged } = work.adopt(part)?;
            all = Adopted {
                taken: all.taken + taken,
                known: all.known + known,
                damaged: all.damaged + damaged,
            };
        }
        work.require_complete()?;
        let cells = work.write_tables(&|| ())?;
        page::write(work.study(), &cells, work.folder(), markdown.as_deref())?;
        Ok::<_, Failure>(json!({
            "folder": work.folder(),
            "shards": work.shards(),
            "taken": all.taken,
            "known": all.known,
            "damaged": all.damaged,
            "written": work.written(),
            "summary": page::summary(work.study(), &cells).to_text(),
        }))
    })?;
    loaded(py, &told)
}
