//! Sweeps: what their numbers must be.

mod closed_form;
mod studies;
mod support;
