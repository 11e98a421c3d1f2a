//! Counts of work.

use super::{COUNTS, fits, share};
use crate::regress::answered::Answered;
use crate::regress::fitted::Fitted;
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};
use crate::regress::trials::SuiteTrials;

/// Of fits and of diagnoses.
pub(super) fn counts() -> Vec<RegressLimit> {
    let limit = |id: &str, title: &str, value: fn(&Fitted) -> Option<f64>, test: LimitTest| {
        let why = "Work is counted, not timed: the count is the same on every computer.";
        RegressLimit::new((id, LimitGroup::Effort), title, why, test, move |t: &SuiteTrials| fits(t, value))
    };
    let search = |id: &str, title: &str, value: fn(&Answered) -> usize| {
        let why = "The search decides how long a diagnosis takes.";
        RegressLimit::new((id, LimitGroup::Effort), title, why, COUNTS, move |t: &SuiteTrials| {
            t.answered().map(|a| value(a) as f64).collect()
        })
    };
    vec![
        limit("iterations", "Gauss-Newton iterations of a fit", |f| Some(f.iterations as f64), COUNTS),
        limit("linearizations", "linearizations of a fit", |f| Some(f.tried as f64), COUNTS),
        limit(
            "not-settled",
            "fits that ran out of iterations",
            |f| Some(share(!f.settled)),
            LimitTest::Share,
        ),
        search("sets", "sets of effects weighed by a diagnosis", |a| a.sets),
        search("rounds", "rounds of linearization and search of a diagnosis", |a| a.rounds),
    ]
}
