//! Wrong answers, grouped by what was hidden and what was said.

use hexbench_truth::campaign::CaseKind;

use super::{CalibrationRecord, Fate};
use crate::pages::groups;

/// Wrong answers of one sort.
#[derive(Debug)]
pub struct MistakeGroup<'a> {
    /// What was hidden.
    pub hidden: String,
    /// What was said.
    pub answer: String,
    /// The trials, the most confident first.
    pub trials: Vec<&'a CalibrationRecord>,
}

/// Groups of answers that state something false: a false name, a false "outside", some of several effects taken for
/// all. The largest first. Of pairs the sort of mistake stands for the answer.
pub fn mistakes(records: &[CalibrationRecord]) -> Vec<MistakeGroup<'_>> {
    let false_answers = records.iter().filter(|r| r.fate >= Fate::Incomplete);
    let confidence = |r: &CalibrationRecord| r.confidence.unwrap_or(0.0);
    let all = groups(false_answers, key).into_iter().map(|((hidden, answer), mut trials)| {
        trials.sort_by(|a, b| confidence(b).total_cmp(&confidence(a)));
        MistakeGroup { hidden, answer, trials }
    });
    all.collect()
}

fn key(r: &CalibrationRecord) -> (String, String) {
    match r.kind {
        CaseKind::Pair => ("two effects".to_owned(), r.fate.word().to_owned()),
        CaseKind::Triple => ("three effects".to_owned(), r.fate.word().to_owned()),
        CaseKind::SeedProtocol => (format!("{} (paper plan)", r.hidden_words()), r.answer()),
        CaseKind::RichForm => (format!("{} (richer form)", r.hidden_words()), r.answer()),
        _ => (r.hidden_words(), r.answer()),
    }
}
