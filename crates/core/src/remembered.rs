//! What functions that are dear to ask have said.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Answers kept at most; then all are forgotten.
const MOST_KEPT: usize = 1 << 18;

/// Answers by question, for threads to share.
#[derive(Debug)]
pub struct Remembered<Q, A>(Mutex<HashMap<Q, A>>);

impl<Q, A> Default for Remembered<Q, A> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<Q: Eq + Hash, A: Copy> Remembered<Q, A> {
    /// The answer to a question, where it is known.
    pub fn get(&self, question: &Q) -> Option<A> {
        self.known().get(question).copied()
    }

    /// The same of some questions.
    pub fn get_all<'q>(&self, questions: impl IntoIterator<Item = &'q Q>) -> Vec<Option<A>>
    where
        Q: 'q,
    {
        let known = self.known();
        questions.into_iter().map(|question| known.get(question).copied()).collect()
    }

    /// Keeps answers.
    pub fn keep(&self, answers: impl IntoIterator<Item = (Q, A)>) {
        let mut known = self.known();
        if known.len() >= MOST_KEPT {
            known.clear();
        }
        known.extend(answers);
    }

    fn known(&self) -> MutexGuard<'_, HashMap<Q, A>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_kept_and_forgotten_once_they_are_many() {
        let remembered = Remembered::default();
        remembered.keep([(1, 10.0), (2, 20.0)]);
        assert_eq!(remembered.get_all(&[2, 3, 1]), [Some(20.0), None, Some(10.0)]);
        remembered.keep((3..MOST_KEPT).map(|question| (question, 0.0)));
        assert_eq!(remembered.get(&1), Some(10.0));
        remembered.keep([(0, 0.0)]);
        remembered.keep([(4, 40.0)]);
        assert_eq!(remembered.get_all(&[1, 4]), [None, Some(40.0)]);
    }
}
