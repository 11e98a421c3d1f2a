//! The native half of the Python package `hexbench`: module `hexbench._native`.
//!
//! Python's half (`crates/python/python/hexbench`) has the classes people use, with their documentation and types; what is here
//! takes plain numbers, arrays and texts, and computes. Units are those of the files: mm, deg, N, N m, um, urad.
//!
//! - Work runs on threads of its own while Python goes on ([`run`]).
//! - A failure is the command's, with the same text, as an exception of `hexbench.errors` ([`error`]).

mod error;
mod json;
mod run;
mod study;

use pyo3::prelude::*;

/// Native half of the package hexbench.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::study::{StudyRunner, StudyWork, study_merge, study_plan, study_run_part};
}
