//! Random streams are independent, and every random number of the bench comes from one.

#![allow(clippy::unwrap_used, reason = "tests: a missing value is a failure")]

mod correlation;
mod reference;
mod sources;
