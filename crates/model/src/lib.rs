//! The identification model.
//!
//! One spring per leg, identified from loaded poses, plus named terms for what the springs leave unexplained.

pub mod absorption;
pub mod answer;
pub mod batch;
mod body;
pub mod campaign;
pub mod candidates;
pub mod chain;
pub mod compare;
pub mod compensate;
pub mod diagnose;
pub mod diagnosis;
pub mod error;
pub mod estimate;
pub mod evidence;
pub mod examination;
pub mod explanation;
pub mod fit;
pub mod fit_named;
pub mod formula;
pub mod frames;
mod intern;
pub mod kinematics;
mod lanes;
pub mod linearization;
pub mod lsq;
pub mod machine;
pub mod model_file;
pub mod next;
pub mod noise;
pub mod observability;
pub mod paper;
mod parallel;
pub mod parameters;
pub mod pattern;
mod period;
pub mod power;
pub mod predict;
pub mod registration;
pub mod residuals;
pub mod runs;
mod scan;
pub mod scatter;
pub mod search;
pub mod selection;
pub mod spring_trials;
pub mod term;
pub mod terms;
pub mod untestable;
pub mod user_term;
pub mod verdict;
pub mod whitening;
pub mod words;

#[cfg(test)]
mod test_machine;
