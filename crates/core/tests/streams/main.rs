//! Random streams are independent.

#![allow(clippy::unwrap_used, reason = "tests: a missing value is a failure")]

mod correlation;
mod reference;
