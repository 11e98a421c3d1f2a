//! Terms of one's own: files, and functions written in Python.

use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::Arc;

use hexbench_app::{Failure, input};
use hexbench_model::application::model_file::Model;
use hexbench_model::effects::term::{Chapter, Term};
use hexbench_model::effects::user_term::{LawOfProgram, LawQuestion, of_function};
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::error::usage;
use crate::run::beside;

/// A term with a function for its law.
#[pyclass(frozen, name = "Term", module = "hexbench._native")]
pub(crate) struct PyTerm(Arc<dyn Term>);

#[pymethods]
impl PyTerm {
    /// Of a term file without formulas. `function` is asked with the number of conditions n, the columns of `variables` (6 n numbers for
    /// one of a leg, else n) and the sizes; it gives an array (n, 6). SI.
    #[new]
    fn of(
        py: Python<'_>,
        header: String,
        acts: String,
        variables: Vec<String>,
        name: String,
        function: Py<PyAny>,
    ) -> PyResult<Self> {
        beside(py, move || {
            let law = Box::new(move |question: &LawQuestion| {
                // An exception goes through the computation to the caller, as a panic does.
                asked(&function, question).unwrap_or_else(|wrong| resume_unwind(Box::new(wrong)))
            });
            let term = of_function(&header, LawOfProgram { acts, variables, name: name.clone(), law });
            Ok(Self(term.map_err(Failure::in_file(name.as_ref()))?))
        })
    }
}

fn asked(function: &Py<PyAny>, question: &LawQuestion) -> PyResult<Vec<[f64; 6]>> {
    Python::attach(|py| {
        let columns: Vec<_> = question.variables.iter().map(|of| PyArray1::from_slice(py, of)).collect();
        let found = function.call1(py, (question.conditions, columns, question.sizes.clone()))?;
        let found: PyReadonlyArray2<'_, f64> = found.extract(py)?;
        let found = found.as_array();
        Ok(found.rows().into_iter().map(|row| std::array::from_fn(|k| row[k])).collect())
    })
}

/// A term of one's own, as it is given.
#[derive(FromPyObject)]
pub(crate) enum OwnTerm {
    Function(Py<PyTerm>),
    File(PathBuf),
}

/// All of them.
pub(crate) fn own_terms(given: &[OwnTerm]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let read = |term: &OwnTerm| match term {
        OwnTerm::Function(term) => Ok(Arc::clone(&term.get().0)),
        OwnTerm::File(path) => Ok(input::user_terms(std::slice::from_ref(path))?.remove(0)),
    };
    given.iter().map(read).collect()
}

/// # Errors
/// No file holds a function.
pub(crate) fn refuse_terms_in_file(py: Python<'_>, model: &Model) -> PyResult<()> {
    let mut own = model.point.active.iter().filter(|a| a.term.info().chapter == Chapter::Own);
    own.find(|a| a.term.definition().is_none()).map_or(Ok(()), |a| {
        Err(usage(
            py,
            &format!("the term {} is a Python function, which files cannot contain", a.id()),
            "Write its law as a formula in a term file, or fit the model again where it is needed.",
        ))
    })
}
