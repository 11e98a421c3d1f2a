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

    /// The same with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (u64, &R)> {
        (0..).zip(&self.answers).filter_map(|(number, answer)| Some((number, answer.as_ref().ok()?)))
    }

    /// Numbers of the trials without an answer, and why.
    pub fn failures(&self) -> impl Iterator<Item = (u64, &String)> {
        (0..).zip(&self.answers).filter_map(|(number, answer)| Some((number, answer.as_ref().err()?)))
    }
}
