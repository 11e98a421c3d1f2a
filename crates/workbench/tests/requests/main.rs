//! What is asked of the server, rightly and wrongly, and what it answers.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod acts;
mod engine;
mod limits;
mod noise;
mod rows;
mod site;
mod table;
