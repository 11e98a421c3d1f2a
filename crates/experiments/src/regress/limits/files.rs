//! Answers on files that do not say what is meant, and on sound ones.

use super::share;
use crate::misread::{MisreadFate, MisreadRecord, is_blamed};
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};

/// The limits.
pub(super) fn all() -> Vec<RegressLimit> {
    vec![
        limit(
            ("files-cause", "misread files: a misstatement that matters and whose cause is not named"),
            "A sign, a unit or an axis that is not what the file says is the first mistake of every user.",
            |r| fate(r).map(|fate| !matches!(fate, MisreadFate::Named | MisreadFate::Refused)),
        ),
        limit(
            ("files-silent", "misread files: a misstatement that matters, and not a word about it"),
            "Nothing is worse than a wrong answer that looks right.",
            |r| fate(r).map(|fate| fate == MisreadFate::Silent),
        ),
        limit(
            ("files-false-alarms", "sound files: the file is blamed"),
            "An effect of the machine, however large, is no mistake of its file.",
            |r| r.misstatement.is_none().then(|| is_blamed(r)),
        ),
    ]
}

/// What became of a misstatement that matters.
fn fate(record: &MisreadRecord) -> Option<MisreadFate> {
    record.fate().filter(|_| record.matters())
}

/// Share of bad answers among those that a limit looks at.
fn limit((id, title): (&str, &str), why: &str, is_bad: fn(&MisreadRecord) -> Option<bool>) -> RegressLimit {
    RegressLimit::new((id, LimitGroup::Files), title, why, LimitTest::Share, move |t| {
        t.files.iter().flatten().filter_map(|r| is_bad(r).map(share)).collect()
    })
}
