//! The newest answers: the next question is often about one of them.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// So many answers by their questions.
pub(super) struct Recent<Q, A> {
    most: usize,
    kept: Mutex<VecDeque<(Q, Arc<A>)>>,
}

impl<Q: Clone + PartialEq, A> Recent<Q, A> {
    /// Keeps the newest, at most so many.
    pub(super) fn of(most: usize) -> Self {
        Self { most, kept: Mutex::default() }
    }

    /// The answer to a question, computed where it is not kept any more.
    ///
    /// # Errors
    /// Those of the computation.
    pub(super) fn answer<E>(
        &self,
        question: &Q,
        compute: impl FnOnce() -> Result<A, E>,
    ) -> Result<Arc<A>, E> {
        if let Some(known) = self.known(question) {
            return Ok(known);
        }
        Ok(self.keep(question, compute()?))
    }

    /// Keeps an answer.
    pub(super) fn keep(&self, question: &Q, answer: A) -> Arc<A> {
        let answer = Arc::new(answer);
        let mut kept = self.lock();
        kept.retain(|(of, _)| of != question);
        kept.push_back((question.clone(), Arc::clone(&answer)));
        while kept.len() > self.most {
            kept.pop_front();
        }
        answer
    }

    fn known(&self, question: &Q) -> Option<Arc<A>> {
        let mut kept = self.lock();
        let at = kept.iter().position(|(of, _)| of == question)?;
        let found = kept.remove(at)?;
        let answer = Arc::clone(&found.1);
        kept.push_back(found);
        Some(answer)
    }

    fn lock(&self) -> MutexGuard<'_, VecDeque<(Q, Arc<A>)>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Q, A> fmt::Debug for Recent<Q, A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at most {} answers", self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_answers_are_kept_and_one_that_is_asked_for_stays() {
        let recent = Recent::of(2);
        let ask = |question: i32, computed: i32| {
            recent.answer(&question, || Ok::<_, ()>(computed)).map(|answer| *answer)
        };
        assert_eq!([ask(1, 10), ask(2, 20), ask(1, 11)], [Ok(10), Ok(20), Ok(10)]);
        assert_eq!([ask(3, 30), ask(1, 12), ask(2, 21)], [Ok(30), Ok(10), Ok(21)]);
        assert_eq!(recent.answer(&4, || Err("no answer")), Err("no answer"));
        recent.keep(&4, 40);
        assert_eq!(ask(4, 41), Ok(40));
    }
}
