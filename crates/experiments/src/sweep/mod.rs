//! Sweeps: how accuracy depends on the choices of an experiment.
//!
//! A study is a full factorial over axes (noise, plan, poses, repeats, geometry, estimator, effect, size) with a number of trials
//! in each cell. A trial is one simulated campaign with a known truth: fitted ([`task::springs`]) or diagnosed
//! ([`task::diagnose`]).
//!
//! ```text
//! study.toml -> Study -> shards, each a pure function of (study, number) -> journal, one file each
//!                        journal, shard after shard -> trials.parquet, cells.csv, page, charts
//! ```
//!
//! - A trial has its own random streams ([`draw`]): results depend neither on threads nor on the order of the work.
//! - A shard is in the journal completely or not at all; missing or damaged shards are computed again
//!   ([`crate::journal`]).
//! - The results are a pure function of the shards in order ([`results`]): computed at once, after any number of
//!   interruptions, or on several machines, they are the same bytes.

pub mod axes;
pub mod bench;
pub mod cells;
pub mod columns;
pub mod cost;
pub mod draw;
pub mod error;
pub mod ideal;
pub mod indices;
pub mod page;
pub mod plan;
pub mod points;
pub mod precision;
pub mod question;
pub mod read;
pub mod results;
pub mod runner;
pub mod shard;
pub mod study;
pub mod task;
pub mod work;

pub use error::StudyError;
pub use runner::Runner;
pub use study::SweepStudy;
pub use work::{Division, Share, Todo, Work, divide};
