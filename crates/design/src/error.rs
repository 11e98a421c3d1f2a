//! Why a plan could not be made.

use hexbench_core::words::joined;
use hexbench_model::error::ModelError;

/// A design problem without an answer.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// Too few poses of the space keep its limits.
    #[error("{} of {tried} random poses of the space are within its limits ({why})", few(*.found))]
    NoPose {
        /// Poses that keep them.
        found: usize,
        /// Poses tried.
        tried: usize,
        /// A limit that is broken.
        why: &'static str,
    },
    /// No plan of this size determines all parameters.
    #[error("no plan that was found determines all {parameters} parameters: {hint}")]
    NotDetermined {
        /// Parameters wanted.
        parameters: usize,
        /// What could be done.
        hint: &'static str,
    },
    /// The time is too short.
    #[error("the budget does not allow a single reading")]
    NoReading,
    /// A budget in time is spent by readings that cost nothing.
    #[error("a reading that takes no time can be repeated forever")]
    FreeReading,
    /// No plan of any size does.
    #[error("no plan in this space determines {}{}", .names.join(", "), without(lacks))]
    NeverDetermined {
        /// Parameters that are not seen, or only together with others.
        names: Vec<String>,
        /// Components of load with which it would determine them.
        lacks: Vec<&'static str>,
    },
    /// Not even all sensors to choose from determine everything.
    #[error("all {candidates} candidate sensors together do not determine {}", .names.join(", "))]
    SensorsNeverDetermine {
        /// Candidates.
        candidates: usize,
        /// Parameters that are not seen, or only together with others.
        names: Vec<String>,
    },
    /// Too few sensors are to be chosen.
    #[error("no set of {number} candidate sensors determines all {parameters} parameters")]
    TooFewSensors {
        /// Sensors wanted.
        number: usize,
        /// Parameters wanted.
        parameters: usize,
        /// As many as are enough, where any number is.
        enough: Option<usize>,
    },
    /// A plan cannot test an effect at all.
    #[error("these poses and loads cannot show {term}: {why}")]
    CannotShow {
        /// Id of the term.
        term: &'static str,
        /// What is missing.
        why: String,
    },
    /// Springs explain all of an effect, whatever is read.
    #[error("no candidate sensor separates {term} from the springs with these poses and loads")]
    NoCandidateShows {
        /// Id of the term.
        term: String,
    },
    /// A quantity of the problem makes no sense.
    #[error("{0}")]
    Bad(String),
    /// The model cannot be evaluated.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// `: it has no load with fy`.
fn without(lacks: &[&str]) -> String {
    if lacks.is_empty() { String::new() } else { format!(": it lacks a load with {}", joined(lacks)) }
}

/// `none`, or `only 12`.
fn few(found: usize) -> String {
    if found == 0 { "none".to_owned() } else { format!("only {found}") }
}
