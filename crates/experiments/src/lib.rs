//! The proving ground: simulated campaigns with a known truth go through the identification, and what it says is compared
//! with what was hidden.
//!
//! | experiment | question |
//! |---|---|
//! | [`recovery`] | is what was hidden found, with honest uncertainty? |
//! | [`interactions`] | are the numbers right when effects act together? |
//! | [`calibration`] | how far can the stated probabilities be trusted? |
//! | [`robustness`] | what do laboratories that do not keep to the assumptions get? |
//! | [`misread`] | is it found that a file does not say what its author meant? |
//! | [`discovery`] | are laws found that no catalogue lists, and only where there are any? |
//! | [`discriminate`] | do the proposed readings tell effects apart? |
//! | [`power`] | which effects does a plan show? |
//! | [`regress`] | did a change make anything worse? |
//! | [`paper`] | what is behind the errors of the paper? |
//! | [`sweep`] | which choice of an experiment is worth what? |
//! | [`challenge`] | how do algorithms in other languages compare? |
//! | [`gate`] | did a change make anyone's algorithm worse? |
//!
//! A run fails beside its baseline by one rule ([`alarm`]). All of them run on one bench ([`harness`]) and keep what is done in one kind of journal ([`journal`]).
//! It holds no physics of its own: campaigns come from `hexbench_truth`, answers from `hexbench_model`.

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
