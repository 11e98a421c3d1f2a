//! Comparison of two results: what changed, and whether the change is significant.
//!
//! A parameter differs by `|a - b| / sqrt(s_a^2 + s_b^2)` combined standard uncertainties. It counts as changed when noise gives so
//! large a difference anywhere among the parameters compared in one of a hundred pairs (Bonferroni). Errors are compared by the
//! ratio of their reduced chi-squares, which follows F for independent readings. Two results from the same readings share their
//! noise: they differ by less than this allows, so that what is marked is marked rightly.

mod between;
mod saved;

pub use between::{Changed, ComparedRuns, ErrorChange, Incompatible, ParameterChange, between, same_subject};
pub use saved::{FORMATS, Head, Origin, Run, RunStep, SavedComparison, SavedDiagnosis, SavedFit, WithOrigin};
