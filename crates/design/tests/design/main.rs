//! Plans, power and the file of a space.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod plans;
mod power;
mod sensors;
mod space_file;
