//! Files, their refusals and their round trips; random streams.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod bad_input;
mod documented_formats;
mod inputs;
mod robots;
mod round_trip;
mod sensors;
mod streams;
mod workbooks;
