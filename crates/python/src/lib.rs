//! The native half of the Python package `hexbench`: module `hexbench._native`.
//!
//! The Python half (`crates/python/python/hexbench`) contains the public classes with documentation and types; the native half
//! takes plain numbers, arrays and texts, and computes. Units are those of the files: mm, deg, N, N m, um, urad.
//!
//! - Computations run on separate threads while Python continues (`run`).
//! - A failure of a command becomes an exception of `hexbench.errors` with the same text (`error`).

#![allow(clippy::needless_pass_by_value, reason = "arguments from Python arrive as values")]

mod arrays;
mod blocks;
mod campaign;
mod command;
mod design;
mod diagnose;
mod entrant;
mod error;
mod json;
mod machine;
mod model;
mod own_sensor;
mod own_term;
mod run;
mod scene;
mod session;
mod shards;
mod study;
mod terms;

use pyo3::prelude::*;

/// Native half of the package hexbench.
#[pymodule]
mod _native {
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use crate::blocks::{legs, regressor, signatures};
    #[pymodule_export]
    use crate::campaign::PyCampaign;
    #[pymodule_export]
    use crate::command::{command, command_names};
    #[pymodule_export]
    use crate::design::{PyPlan, PySensorChoice, choose_sensors, design};
    #[pymodule_export]
    use crate::diagnose::{PyComparison, PyDiagnosis, PyDiscovery, compare, diagnose, discover};
    #[pymodule_export]
    use crate::entrant::{answer_case, answer_of_function, challenge_run_inside, gate};
    #[pymodule_export]
    use crate::machine::{PyHexapod, write_text};
    #[pymodule_export]
    use crate::model::{PyModel, fit};
    #[pymodule_export]
    use crate::own_term::PyTerm;
    #[pymodule_export]
    use crate::scene::simulate;
    #[pymodule_export]
    use crate::session::PySession;
    #[pymodule_export]
    use crate::shards::{ExperimentWork, ShardRunner};
    #[pymodule_export]
    use crate::study::{StudyTrials, StudyWork, study_merge, study_plan, study_run_part};
    #[pymodule_export]
    use crate::terms::terms;
}
