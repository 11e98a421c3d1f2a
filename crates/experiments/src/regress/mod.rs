//! Accuracy regression: a fixed suite of campaigns with a known truth, compared with a committed baseline. [`crate::alarm`] has what it
//! shares with the gate of other programs.
//!
//! - [`suite`]: what is run; [`trials`]: running it; [`fitted`], [`answered`]: one campaign in numbers.
//! - [`limits`]: what is measured and why, one test case each; [`limit`]: their parts.
//! - [`sample`]: what is kept of the values of a limit; [`rule`]: when a change is more than chance; [`notice`]: what change
//!   would be noticed.
//! - [`baseline`]: the committed file; [`comparison`]: a run compared with it; [`cases`], [`summary`]: for continuous
//!   integration.
//! - [`unchanged`]: runs that must not fail; [`planted`]: runs that must; [`document`]: the page about both.

pub mod answered;
pub mod baseline;
pub mod cases;
pub mod comparison;
pub mod distance;
pub mod document;
pub mod figure;
pub mod fitted;
pub mod gathered;
pub mod limit;
pub mod limits;
pub mod notice;
pub mod planted;
pub mod rule;
pub mod sample;
pub mod suite;
pub mod summary;
pub mod trials;
pub mod unchanged;
