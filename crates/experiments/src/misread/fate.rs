//! What became of a misstatement.

use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::misstatements::MisstatementEntry;
use serde::{Deserialize, Serialize};

use super::MisreadRecord;

/// Words of `findings[].kind` that speak of a file as a whole. In a sound campaign each is a false alarm.
pub const WHOLE_FILE: [&str; 23] = [
    "deflection-sign",
    "wrench-sign",
    "states-exchanged",
    "rotation-sign",
    "moment-sign",
    "unit",
    "axes",
    "leg-order",
    "joints-exchanged",
    "origin",
    "geometry",
    "wrench-frame",
    "deflection-frame",
    "angle-convention",
    "rotation-convention",
    "reference-missing",
    "row-order",
    "idle-column",
    "zero-error",
    "measured-pose",
    "commanded-pose",
    "copies",
    "holdout",
];

/// What became of a misstatement, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MisreadFate {
    /// The first finding about the file is a right cause, or an effect is named that says the same.
    Named,
    /// A right cause is among the findings about the file.
    AmongOthers,
    /// Findings speak of the file, and none is right.
    WrongCause,
    /// No cause, but the answer is not one to rely on: measurement, outside, ambiguous or undecided.
    Noticed,
    /// The files are refused, or nothing can be computed from them.
    Refused,
    /// The springs are called adequate or effects are named, without a word about the file.
    Silent,
}

hexbench_core::worded! {
    /// A few words for tables.
    MisreadFate::words {
        Named => "named",
        AmongOthers => "among others",
        WrongCause => "wrong cause",
        Noticed => "noticed",
        Refused => "refused",
        Silent => "silent",
    }
}

impl MisreadFate {
    /// What the answer makes of a misstatement.
    pub(super) fn of(entry: &MisstatementEntry, record: &MisreadRecord) -> Self {
        let is_right = |kind: &&str| entry.is_caused_by(kind);
        // A right word counts even where it speaks of more than files, as `noise-level` of a misstated sigma.
        let about: Vec<&str> = record
            .findings
            .iter()
            .map(String::as_str)
            .filter(|kind| WHOLE_FILE.contains(kind) || is_right(kind))
            .collect();
        let says_the_same = record.added.iter().any(|id| entry.effects.contains(&id.as_str()));
        match (about.first(), record.verdict) {
            (Some(first), _) if is_right(first) => Self::Named,
            (Some(_), _) if about.iter().any(is_right) => Self::AmongOthers,
            (Some(_), _) => Self::WrongCause,
            (None, None) => Self::Refused,
            (None, Some(_)) if says_the_same => Self::Named,
            (None, Some(Verdict::Adequate | Verdict::Named)) => Self::Silent,
            (None, Some(_)) => Self::Noticed,
        }
    }
}
