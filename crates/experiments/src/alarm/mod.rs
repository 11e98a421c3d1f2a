//! The rule by which a run fails compared with its baseline; `regress` and `gate` share it.
//!
//! A limit fails when its figure is worse by more than its tolerance *and* by more than chance explains. Chance is weighed by the level of
//! a limit: its share of [`FALSE_ALARM`], the probability that a run of an unchanged program fails.
//!
//! - [`verdict`]: what a limit can say, the probabilities, their words; [`update`], [`mod@file`]: the history of a
//!   baseline, and its file.
//! - [`same_cases`]: the rule for the same cases before and after, with and without chance; [`exchange`]: its exact tests.
//! - [`junit`], [`table`]: a comparison for continuous integration and for people.

pub mod exchange;
pub mod file;
pub mod junit;
pub mod same_cases;
pub mod table;
pub mod update;
pub mod verdict;

pub use file::BaselineFileError;
pub use update::Update;
pub(crate) use verdict::bisected;
pub use verdict::{FALSE_ALARM, LimitVerdict, POWER, probability, share_of_level};
