//! Wrong answers, grouped by what was hidden and what was said.

use std::collections::BTreeMap;

use hexbench_truth::campaign::CaseKind;

use super::{CalibrationRecord, Fate};

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
    let mut groups: BTreeMap<(String, String), Vec<&CalibrationRecord>> = BTreeMap::new();
    for record in records.iter().filter(|r| r.fate >= Fate::Incomplete) {
        groups.entry(key(record)).or_default().push(record);
    }
    let mut all: Vec<MistakeGroup<'_>> = groups
        .into_iter()
        .map(|((hidden, answer), mut trials)| {
            trials.sort_by(|a, b| b.confidence.unwrap_or(0.0).total_cmp(&a.confidence.unwrap_or(0.0)));
            MistakeGroup { hidden, answer, trials }
        })
        .collect();
    all.sort_by_key(|g| std::cmp::Reverse(g.trials.len()));
    all
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
