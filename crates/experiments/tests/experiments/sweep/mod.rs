//! Sweeps: what their numbers must be.

mod closed_form;
mod studies;
pub(crate) mod support;
