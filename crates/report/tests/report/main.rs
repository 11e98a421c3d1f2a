//! Charts, and the same page in every medium.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod charts;
mod media;
