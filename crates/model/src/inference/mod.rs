//! Inference: evidence of terms and patterns, the examination of the readings, the verdict.

pub mod absorption;
pub(crate) mod alone;
pub mod candidates;
pub mod diagnosis;
pub mod discovery;
pub mod discrepancy;
pub(crate) mod elongations;
pub mod evidence;
pub mod examination;
pub mod explanation;
pub(crate) mod forms;
pub mod gain;
pub(crate) mod golden;
pub mod importance;
pub(crate) mod leg_sums;
pub mod misread;
pub mod pattern;
pub mod power;
pub(crate) mod rivals;
pub(crate) mod scan;
pub mod search;
pub(crate) mod seen;
pub mod selection;
pub mod verdict;
