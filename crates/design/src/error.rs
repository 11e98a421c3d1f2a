//! Why a plan could not be made.

use hexbench_model::error::ModelError;

/// A design problem without an answer.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// Too few poses of the space keep its limits.
    #[error("only {found} of {tried} poses drawn from the space keep its limits ({why})")]
    NoPose {
        /// Poses that keep them.
        found: usize,
        /// Poses tried.
        tried: usize,
        /// A limit that is broken.
        why: &'static str,
    },
    /// No plan of this size determines all parameters.
    #[error("{readings} readings of this space do not determine {parameters} parameters{hint}")]
    NotDetermined {
        /// Readings of the plan.
        readings: usize,
        /// Parameters wanted.
        parameters: usize,
        /// What could be done.
        hint: &'static str,
    },
    /// A quantity of the problem makes no sense.
    #[error("{0}")]
    Bad(String),
    /// The model cannot be evaluated.
    #[error(transparent)]
    Model(#[from] ModelError),
}
