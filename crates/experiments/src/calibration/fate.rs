//! What became of a truth: finer than right, honest and wrong.

use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::Diagnosis;
use serde::{Deserialize, Serialize};

use crate::trial::{Outcome, Trial, reported};

/// What became of the hidden truth, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Fate {
    /// Exactly the truth is said.
    Right,
    /// Ambiguous, the truth among what is kept.
    Honest,
    /// Ambiguous, without the truth among what is kept, or although there is nothing or something outside.
    Undecided,
    /// The springs are called adequate although something is hidden.
    Missed,
    /// Only true effects are named, but not all of them.
    Incomplete,
    /// "Outside" is said, but all that is hidden is in the catalogue, or nothing is.
    FalseOutside,
    /// An effect is named that is not there.
    FalseName,
}

hexbench_core::worded! {
    /// A word for tables.
    Fate::word {
        Right => "right",
        Honest => "honest",
        Undecided => "undecided",
        Missed => "missed",
        Incomplete => "incomplete",
        FalseOutside => "false outside",
        FalseName => "false name",
    }
}

impl Fate {
    /// Fate of a trial.
    pub fn of(trial: &Trial) -> Self {
        let d = &trial.study.diagnosis;
        match (trial.outcome(), d.verdict) {
            (Outcome::Right, _) => Self::Right,
            (Outcome::Honest, _) => Self::Honest,
            (Outcome::Wrong, Verdict::Ambiguous | Verdict::Undecided) => Self::Undecided,
            (Outcome::Wrong, Verdict::Adequate | Verdict::Named) if invents(d, &trial.hidden) => {
                Self::FalseName
            }
            (Outcome::Wrong, Verdict::Adequate | Verdict::Measurement) => Self::Missed,
            (Outcome::Wrong, Verdict::Outside) => Self::FalseOutside,
            (Outcome::Wrong, Verdict::Named) => Self::Incomplete,
        }
    }
}

fn invents(d: &Diagnosis, hidden: &[&str]) -> bool {
    reported(d).iter().any(|id| !hidden.contains(&id.as_str()))
}
