//! The limits of a comparison as test cases.

use super::comparison::{LimitOutcome, RunComparison};
use super::limit::LimitGroup;
use crate::alarm::LimitVerdict;
use crate::alarm::junit::{LimitCase, LimitCaseOutcome, LimitFailure, XmlError, junit};

/// The command that makes a run the baseline.
pub(super) const UPDATE: &str = "hexbench regress --update --reason TEXT";

/// `JUnit` XML: one suite for each group, one test case for each limit.
///
/// # Errors
/// Those of the XML writer.
pub fn xml(comparison: &RunComparison) -> Result<String, XmlError> {
    let of_group =
        |group: &LimitGroup| comparison.findings.iter().filter(|f| f.group == *group).map(case).collect();
    let cases: Vec<Vec<LimitCase>> = LimitGroup::ALL.iter().map(of_group).collect();
    junit("hexbench regress", &cases.concat())
}

fn case(finding: &LimitOutcome) -> LimitCase {
    let failed = || LimitFailure {
        now: finding.now.clone(),
        before: finding.before.clone(),
        next: finding.group.next_step().to_owned(),
        update: UPDATE.to_owned(),
    };
    LimitCase {
        suite: format!("hexbench.regress.{}", finding.group.word()),
        title: finding.title.clone(),
        id: finding.id.clone(),
        why: finding.why.clone(),
        figures: finding.complaint(),
        outcome: LimitCaseOutcome::of((finding.verdict == LimitVerdict::Worse).then(failed)),
    }
}
