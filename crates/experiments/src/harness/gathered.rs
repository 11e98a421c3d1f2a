//! What the trials of an experiment gave.

use super::Protocol;

/// A record, or why there is none.
pub type TrialResult<R> = Result<R, String>;

/// What the trials gave, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Gathered<R> {
    /// One for each trial.
    pub answers: Vec<TrialResult<R>>,
}

impl<R> Gathered<R> {
    pub(super) fn new(answers: Vec<TrialResult<R>>) -> Self {
        Self { answers }
    }

    /// The records of trials with an answer, and the names of the others with the reasons.
    pub fn split<P: Protocol<Record = R>>(self, protocol: &P) -> (Vec<R>, Vec<(String, String)>) {
        let failures = self.failures().map(|(n, why)| (protocol.name(n), why.clone())).collect();
        (self.answers.into_iter().flatten().collect(), failures)
    }

    /// The records of trials with an answer.
    pub fn records(&self) -> impl Iterator<Item = &R> {
        self.answers.iter().flatten()
    }

    /// The same with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (u64, &R)> {
        (0..).zip(&self.answers).filter_map(|(number, answer)| Some((number, answer.as_ref().ok()?)))
    }

    /// Numbers of the trials without an answer, and why.
    pub fn failures(&self) -> impl Iterator<Item = (u64, &String)> {
        (0..).zip(&self.answers).filter_map(|(number, answer)| Some((number, answer.as_ref().err()?)))
    }
}
