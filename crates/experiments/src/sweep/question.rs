//! What a study is to answer.

use crate::sweep::results::Counted;

/// A question, answered in a sentence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Question {
    /// Which plan, the cheapest, sees or names a hidden effect in at least this share of the trials?
    Share(Counted, f64),
    /// Which plan, the cheapest, has at most this error of stiffness (root mean square, percent)?
    Error(f64),
    /// Which index of a plan predicts its error of stiffness best?
    Index,
}

/// The chance that any interval of an answer misses.
pub const ERROR: f64 = 0.05;
