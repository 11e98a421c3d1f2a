//! Counts of work.

use super::{COUNTS, fits, share};
use crate::regress::answered::Answered;
use crate::regress::fitted::Fitted;
use crate::regress::limit::{Group, Limit, Test};
use crate::regress::trials::Trials;

/// Of fits and of diagnoses.
pub(super) fn counts() -> Vec<Limit> {
    let limit = |id: &str, title: &str, value: fn(&Fitted) -> Option<f64>, test: Test| {
        let why = "Work is counted, not timed: the count is the same on every computer.";
        Limit::new((id, Group::Effort), title, why, test, move |t: &Trials| fits(t, value))
    };
    let search = |id: &str, title: &str, value: fn(&Answered) -> usize| {
        let why = "The search decides how long a diagnosis takes.";
        Limit::new((id, Group::Effort), title, why, COUNTS, move |t: &Trials| {
            t.answered().map(|a| value(a) as f64).collect()
        })
    };
    vec![
        limit("iterations", "Gauss-Newton iterations of a fit", |f| Some(f.iterations as f64), COUNTS),
        limit("linearisations", "linearisations of a fit", |f| Some(f.tried as f64), COUNTS),
        limit("not-settled", "fits that ran out of iterations", |f| Some(share(!f.settled)), Test::Share),
        search("sets", "sets of effects weighed by a diagnosis", |a| a.sets),
        search("rounds", "rounds of linearisation and search of a diagnosis", |a| a.rounds),
    ]
}
