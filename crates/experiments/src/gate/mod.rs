//! Accuracy regression of a user's program: its scores on a challenge, compared case by case with those of a committed
//! baseline.
//!
//! ```text
//! record:  suite --make--> cases --program, several times--> scores --> baseline (scores by case, digests, history)
//! check:   the same cases --program as it is now--> scores, case by case beside the baseline --> limits
//! ```
//!
//! - [`figure`]: what is compared; [`values`]: scores of runs by case, as the baseline keeps them.
//! - [`suite`]: which cases; [`work`]: running the program over them; [`baseline`]: the committed file.
//! - [`comparison`]: the current scores compared with the baseline, by the rule of [`crate::alarm::same_cases`]; [`notice`]:
//!   the changes that would be noticed.
//! - [`page`], [`cases`]: output for people and for continuous integration.

pub mod baseline;
pub mod cases;
pub mod comparison;
pub mod error;
pub mod figure;
pub mod notice;
pub mod page;
pub mod suite;
pub mod values;
pub mod work;

pub use baseline::{GateBaseline, GateEntrant};
pub use comparison::GateComparison;
pub use error::GateError;
pub use suite::GateSuite;
pub use work::{GateShare, GateWork};

#[cfg(test)]
mod tests;
