//! The figures of a comparison as test cases.

use super::comparison::{GateComparison, GateOutcome};
use super::page::{figure, notice};
use crate::alarm::junit::{LimitCase, LimitCaseOutcome, LimitFailure, XmlError, junit};
use crate::alarm::{LimitVerdict, probability};

/// The command that makes a run the baseline.
const UPDATE: &str = "hexbench gate check --update --reason TEXT";
/// The same for a function.
const UPDATE_INSIDE: &str = "hexbench.gate_check(BASELINE, function, update=True, reason=TEXT)";

/// What makes the scores as they are the baseline.
pub fn update(inside: bool) -> &'static str {
    if inside { UPDATE_INSIDE } else { UPDATE }
}

/// `JUnit` XML: one test case for each figure.
///
/// # Errors
/// Those of the XML writer.
pub fn xml(comparison: &GateComparison) -> Result<String, XmlError> {
    let cases: Vec<LimitCase> = comparison.findings.iter().map(|f| case(f, comparison.inside)).collect();
    junit("hexbench gate", &cases)
}

fn case(found: &GateOutcome, inside: bool) -> LimitCase {
    let of = found.figure();
    let [before, now] = [0, 1].map(|k| figure(found, k));
    let chance = found.chance.map(|p| format!("; by chance {}", probability(p))).unwrap_or_default();
    let [worse, better] = found.moved;
    let figures = format!("now {now}, baseline {before}: {worse} cases worse, {better} better{chance}");
    let failed = || LimitFailure { now, before, next: of.next.to_owned(), update: update(inside).to_owned() };
    LimitCase {
        suite: "hexbench.gate".to_owned(),
        title: found.title.clone(),
        id: found.id.clone(),
        why: format!("{} It would notice {}.", of.why, notice(&found.noticed)),
        figures,
        outcome: if found.is_stated_now() {
            LimitCaseOutcome::of((found.verdict == LimitVerdict::Worse).then(failed))
        } else {
            LimitCaseOutcome::NotJudged
        },
    }
}
