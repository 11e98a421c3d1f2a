//! Answers of the diagnosis, and the probabilities stated with them.

use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::campaign::CaseKind;

use super::{ROUGH, share, values};
use crate::calibration::{CalibrationRecord, Fate, is_well_visible};
use crate::regress::limit::{LimitGroup, LimitTest, LimitUnit, RegressLimit};

/// Nats between a stated probability and the truth: from 99.9 % to what no search weighs.
const NATS: LimitTest = LimitTest::Size { range: [1e-3, 14.0], least: ROUGH, unit: LimitUnit::Plain };
/// Stated probability from which an answer counts as sure.
const SURE: f64 = 0.9;

/// Shares of bad answers, three lines each: id and title, why, among which records what is bad.
macro_rules! bad {
    ($($id:literal $title:literal [$why:literal] $among:expr => $is_bad:expr;)+) => {
        vec![$(share_of(($id, $title, $why), $among, $is_bad)),+]
    };
}

fn share_of(
    (id, title, why): (&str, &str, &str),
    among: fn(&CalibrationRecord) -> bool,
    is_bad: fn(&CalibrationRecord) -> bool,
) -> RegressLimit {
    RegressLimit::new((id, LimitGroup::Diagnosis), title, why, LimitTest::Share, move |t| {
        values(t, |r| among(r).then(|| share(is_bad(r))))
    })
}

/// What is said.
pub(super) fn answers() -> Vec<RegressLimit> {
    bad! {
        "false-names" "effects named that are not there"
            ["Sends people to repair what is not broken."]
            |_| true => |r| r.fate == Fate::FalseName;
        "false-outside" "\"outside\" said wrongly"
            ["Sends people to look for physics that is not there."]
            |r| !r.is_outside() => |r| r.verdict == Verdict::Outside;
        "false-statements" "answers that state something false"
            ["Ambiguous is honest, wrong is not."]
            |_| true => |r| r.fate >= Fate::Incomplete;
        "not-right" "answers other than exactly the truth"
            ["The usefulness of the diagnosis in one figure."]
            |_| true => |r| r.fate != Fate::Right;
        "single-not-named" "one well visible effect, not named"
            ["The plainest case."]
            |r| r.kind == CaseKind::Single && is_well_visible(r) => |r| r.fate != Fate::Right;
        "pair-not-named" "two well visible effects, not both named"
            ["Effects hide each other."]
            |r| r.kind == CaseKind::Pair && is_well_visible(r) => |r| r.fate != Fate::Right;
        "outside-not-noticed" "something well visible outside the catalogue, not noticed"
            ["\"It is none of the effects I know\" must be a possible answer."]
            |r| r.is_outside() && is_well_visible(r) => |r| r.fate != Fate::Right;
        "clean-not-adequate" "nothing hidden, but not called adequate"
            ["A sound machine must pass."]
            |r| r.hidden.is_empty() => |r| r.fate != Fate::Right;
        "missed" "springs called adequate although an effect is well visible"
            ["A clean bill of health for a machine that is not sound."]
            |r| !r.hidden.is_empty() && is_well_visible(r) => |r| r.fate == Fate::Missed;
        "undecided" "ambiguous without the truth among what is kept"
            ["Ambiguous must still hold the truth."]
            |_| true => |r| r.fate == Fate::Undecided;
    }
}

/// How sure it is said.
pub(super) fn probabilities() -> Vec<RegressLimit> {
    let wrong_though_sure =
        |r: &CalibrationRecord| r.confidence.filter(|p| *p >= SURE).map(|_| share(r.fate != Fate::Right));
    limits! { LimitGroup::Probabilities;
        "sure-but-wrong" "answers stated with 90 % or more that are not the truth"
            ["A stated probability is a promise."]
            LimitTest::Share => move |t| values(t, wrong_though_sure);
        "credible-sets" "credible sets of 95 % without the truth, where it is well visible"
            ["People keep the set and rule out the rest."]
            LimitTest::Share => |t| values(t, |r| is_well_visible(r).then(|| share(!r.is_covered())));
        "log-score" "nats between the probability stated for the truth and certainty"
            ["The logarithmic score punishes both wrong certainty and needless doubt."]
            NATS => |t| values(t, |r| Some(-r.truth.max(f64::MIN_POSITIVE).ln()));
    }
}
