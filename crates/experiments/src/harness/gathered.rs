//! What the trials of an experiment gave.

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

    /// The records of trials with an answer.
    pub fn records(&self) -> impl Iterator<Item = &R> {
        self.answers.iter().flatten()
    }

    /// Why trials have no answer.
    pub fn failures(&self) -> impl Iterator<Item = &String> {
        self.answers.iter().filter_map(|answer| answer.as_ref().err())
    }
}
