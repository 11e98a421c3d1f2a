//! Experiments: the identification runs on simulated campaigns with a known truth, and its answers are compared with that
//! truth.
//!
//! | experiment | question |
//! |---|---|
//! | [`recovery`] | are hidden effects identified, with correct uncertainties? |
//! | [`interactions`] | are the numbers right when effects act together? |
//! | [`calibration`] | how far can the stated probabilities be trusted? |
//! | [`robustness`] | what happens if a laboratory violates the assumptions? |
//! | [`misread`] | are misstatements of files detected? |
//! | [`sensors`] | how good are diagnoses from gauges, balls, levels and scales? |
//! | [`discovery`] | are laws outside the catalogue found if and only if they are present? |
//! | [`discriminate`] | do the proposed readings separate effects? |
//! | [`power`] | which effects can a plan detect? |
//! | [`regress`] | did a change make anything worse? |
//! | [`paper`] | what causes the errors of the paper? |
//! | [`sweep`] | how much does each choice in an experiment improve accuracy? |
//! | [`challenge`] | how do algorithms in other languages compare? |
//! | [`gate`] | did a change make a user's algorithm worse? |
//!
//! One rule ([`alarm`]) decides whether a run is worse than its baseline. All experiments share one harness ([`harness`]) and one kind of journal
//! ([`journal`]). The crate contains no physics: campaigns come from `hexbench_truth`, answers from `hexbench_model`.

pub mod alarm;
pub mod calibration;
pub mod challenge;
pub mod discovery;
pub mod discriminate;
pub mod error;
pub mod gate;
pub mod harness;
pub mod interactions;
pub mod journal;
pub mod keys;
pub mod misread;
mod pages;
pub mod paper;
pub mod power;
pub mod recovery;
pub mod regress;
pub mod robustness;
pub mod sensors;
mod shares;
pub mod sized;
pub mod sweep;
pub mod trial;

pub use error::ExperimentError;
pub use trial::{Outcome, Trial, TrialError};
