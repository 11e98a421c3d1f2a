//! A comparison as `JUnit` XML: one test case for each limit.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

pub use quick_junit::SerializeError as XmlError;

use super::comparison::{LimitOutcome, RunComparison};
use super::limit::LimitGroup;
use super::rule::LimitVerdict;

/// One suite for each group, one case for each limit; no times, so that the same run gives the same bytes.
///
/// # Errors
/// Those of the XML writer.
pub fn junit(comparison: &RunComparison) -> Result<String, XmlError> {
    let mut report = Report::new("hexbench regress");
    for group in LimitGroup::ALL {
        let mut suite = TestSuite::new(format!("hexbench.regress.{}", group.word()));
        suite.add_test_cases(comparison.findings.iter().filter(|f| f.group == group).map(case));
        report.add_test_suite(suite);
    }
    report.to_string()
}

fn case(finding: &LimitOutcome) -> TestCase {
    let mut case = TestCase::new(finding.title.as_str(), status(finding));
    case.set_classname(format!("hexbench.regress.{}", finding.group.word()));
    case.set_system_out(format!("{}\n{}", finding.why, finding.complaint()));
    case
}

fn status(finding: &LimitOutcome) -> TestCaseStatus {
    if finding.verdict != LimitVerdict::Worse {
        return TestCaseStatus::success();
    }
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_type("regression").set_message(finding.complaint()).set_description(format!(
        "{}\nlimit: {}\nnow: {}\nexpected: as the baseline, {}, as far as chance can tell\nwhy it matters: {}\nnext: {}\n\
         Meant? `hexbench regress --update --reason TEXT` makes this the baseline.",
        finding.title,
        finding.id,
        finding.now,
        finding.before,
        finding.why,
        finding.group.next_step(),
    ));
    status
}
