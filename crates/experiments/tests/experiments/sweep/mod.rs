//! Sweeps: what their numbers must be.

mod choices;
mod closed_form;
mod gauges;
mod own_effects;
mod precision;
mod questions;
mod studies;
pub(crate) mod support;
