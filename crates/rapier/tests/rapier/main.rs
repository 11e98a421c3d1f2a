//! The second world beside the first, and on its way to rest.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod sensors;
mod transient;
mod witness;
