//! Sweeps: what their numbers must be.

mod closed_form;
mod gauges;
mod studies;
pub(crate) mod support;
