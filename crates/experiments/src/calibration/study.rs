//! Running the protocol.

use hexbench_truth::campaign::{Case, Kind};
use rayon::prelude::*;

use super::{DISTANCES, Protocol, Record};
use crate::trial::TrialError;

/// All trials of a protocol.
#[derive(Debug)]
pub struct Calibration {
    /// What was run.
    pub protocol: Protocol,
    /// Trials with an answer, in the order of the protocol.
    pub records: Vec<Record>,
    /// Trials without one.
    pub failures: Vec<Failure>,
}

/// A trial without an answer.
#[derive(Debug)]
pub struct Failure {
    /// Kind of the campaign.
    pub kind: Kind,
    /// Number within the kind.
    pub index: usize,
    /// Why.
    pub cause: TrialError,
}

/// The campaign of one trial.
///
/// # Errors
/// [`TrialError::Truth`] when the effect shows in no plan and machine tried.
pub fn case(kind: Kind, index: usize, seed: u64) -> Result<Case, TrialError> {
    Ok(Case::draw(kind, index, seed, Some(DISTANCES))?)
}

/// Runs every trial; `done` is called after each. One stream of random numbers per trial: the same seed gives the same
/// records on any number of threads.
pub fn calibrate(protocol: Protocol, done: &(dyn Fn() + Sync)) -> Calibration {
    let one = |&(kind, index): &(Kind, usize)| {
        let record = case(kind, index, protocol.seed).and_then(|case| Record::of(&case));
        done();
        record.map_err(|cause| Failure { kind, index, cause })
    };
    let answers: Vec<Result<Record, Failure>> = protocol.jobs().par_iter().map(one).collect();
    let (mut records, mut failures) = (Vec::new(), Vec::new());
    for answer in answers {
        match answer {
            Ok(record) => records.push(record),
            Err(failure) => failures.push(failure),
        }
    }
    Calibration { protocol, records, failures }
}
