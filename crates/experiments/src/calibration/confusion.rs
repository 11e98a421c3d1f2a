//! Hidden effect against answer.

use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::campaign::CaseKind;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use super::CalibrationRecord;

/// Distance from which an effect counts as well visible: a chi-square test for it would hardly ever overlook it.
pub const WELL_VISIBLE: f64 = 10.0;

/// Counts of answers to each hidden truth.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfusionMatrix {
    /// What was hidden: effects of the catalogue, then what it lacks, then nothing.
    pub hidden: Vec<String>,
    /// What was said: effects, several effects, outside, ambiguous, adequate.
    pub answers: Vec<String>,
    /// Trials, by hidden truth and answer.
    pub counts: Vec<Vec<usize>>,
}

/// Answers that are no single effect, in the order of their columns.
const OTHER_ANSWERS: [&str; 4] =
    ["several effects", Verdict::Outside.word(), Verdict::Ambiguous.word(), Verdict::Adequate.word()];

impl ConfusionMatrix {
    /// Confusion over trials with one effect or none.
    pub fn of<'a>(records: impl Iterator<Item = &'a CalibrationRecord>) -> Self {
        let pairs: Vec<(String, String)> =
            records.filter(|r| r.hidden.len() < 2).map(|r| (truth(r), answer(r))).collect();
        let hidden = in_order(pairs.iter().map(|p| p.0.clone()).collect());
        let named = pairs.iter().map(|p| p.1.clone()).chain(hidden.iter().filter(|id| is_term(id)).cloned());
        let answers = in_order(named.chain(OTHER_ANSWERS.map(str::to_owned)).collect());
        let count = |row: &String, column: &String| {
            pairs.iter().filter(|(truth, answer)| truth == row && answer == column).count()
        };
        let counts = hidden.iter().map(|row| answers.iter().map(|column| count(row, column)).collect());
        Self { counts: counts.collect(), hidden, answers }
    }

    /// Share of each answer among the trials with the same hidden truth.
    pub fn shares(&self) -> Vec<Vec<f64>> {
        let row = |counts: &Vec<usize>| {
            let total = counts.iter().sum::<usize>().max(1) as f64;
            counts.iter().map(|&n| n as f64 / total).collect()
        };
        self.counts.iter().map(row).collect()
    }
}

/// Well visible, or without an effect.
pub fn is_well_visible(record: &CalibrationRecord) -> bool {
    record.hidden.is_empty() || record.distance.unwrap_or(record.total_distance) >= WELL_VISIBLE
}

fn truth(record: &CalibrationRecord) -> String {
    let words = record.hidden_words();
    if record.kind == CaseKind::RichForm { format!("{words} (richer form)") } else { words }
}

fn answer(record: &CalibrationRecord) -> String {
    if record.verdict == Verdict::Named && record.added.len() > 1 {
        OTHER_ANSWERS[0].to_owned()
    } else {
        record.answer()
    }
}

fn is_term(word: &str) -> bool {
    REGISTRY.iter().any(|e| e.id == word && e.shows != Shows::Outside)
}

/// Each word once: effects in the order of the catalogue, then what is no effect.
fn in_order(mut words: Vec<String>) -> Vec<String> {
    let rank = |word: &str| {
        let id = word.split(' ').next().unwrap_or(word);
        let of_effect = REGISTRY.iter().position(|e| e.id == id);
        of_effect.or_else(|| Some(REGISTRY.len() + OTHER_ANSWERS.iter().position(|a| *a == word)?))
    };
    // No rank at all is "none": the last row.
    words
        .sort_by(|a, b| rank(a).is_none().cmp(&rank(b).is_none()).then(rank(a).cmp(&rank(b))).then(a.cmp(b)));
    words.dedup();
    words
}
