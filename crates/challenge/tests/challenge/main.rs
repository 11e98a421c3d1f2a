//! Challenges from suite to scores, with programs that behave and programs that do not.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on must fail")]

mod made;
mod runs;
mod scores;
mod support;
