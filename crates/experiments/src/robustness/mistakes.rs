//! Wrong answers, grouped by the fault and what was said.

use super::RobustnessRecord;
use crate::pages::groups;
use crate::trial::Outcome;

/// Wrong answers of one sort.
#[derive(Debug)]
pub struct FaultMistakes<'a> {
    /// Id of the fault.
    pub fault: &'static str,
    /// True on clean machines.
    pub is_clean: bool,
    /// What was said of the machine.
    pub answer: String,
    /// Findings told beside it.
    pub findings: String,
    /// The trials.
    pub trials: Vec<&'a RobustnessRecord>,
}

/// Groups of answers that are wrong about the machine, the largest first.
pub fn mistakes(records: &[RobustnessRecord]) -> Vec<FaultMistakes<'_>> {
    let wrong = records.iter().filter(|r| r.outcome() == Outcome::Wrong);
    let key = |r: &RobustnessRecord| (r.fault, r.is_clean(), answer(r), r.findings.join(", "));
    let group = |((fault, is_clean, answer, findings), trials)| FaultMistakes {
        fault,
        is_clean,
        answer,
        findings,
        trials,
    };
    groups(wrong, key).into_iter().map(group).collect()
}

/// Verdict, and what is wrong with what it names.
fn answer(r: &RobustnessRecord) -> String {
    let verdict = r.answer.verdict.word();
    let false_names: Vec<&str> =
        r.answer.added.iter().map(String::as_str).filter(|id| !r.answer.contains(id)).collect();
    if false_names.is_empty() { verdict.to_owned() } else { format!("{verdict}: {}", false_names.join("+")) }
}
