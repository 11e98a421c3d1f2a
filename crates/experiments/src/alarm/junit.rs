//! A comparison as `JUnit` XML: one test case for each limit.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

pub use quick_junit::SerializeError as XmlError;

/// One limit as a test case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LimitCase {
    /// Suite it belongs to, with dots.
    pub suite: String,
    /// Its name.
    pub title: String,
    /// Short name without blanks.
    pub id: String,
    /// Why it exists.
    pub why: String,
    /// Figures of now and of the baseline, one line.
    pub figures: String,
    /// What came of it.
    pub outcome: LimitCaseOutcome,
}

/// What came of a limit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LimitCaseOutcome {
    /// The figure is within it.
    Passed,
    /// The figure is beyond it.
    Failed(LimitFailure),
    /// There is no figure: neither passed nor failed, and counted as skipped.
    NotJudged,
}

impl LimitCaseOutcome {
    /// Failed where there is a failure, else passed.
    pub(crate) fn of(failure: Option<LimitFailure>) -> Self {
        failure.map_or(Self::Passed, Self::Failed)
    }
}

/// What a failed limit tells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LimitFailure {
    /// The figure now.
    pub now: String,
    /// The figure of the baseline.
    pub before: String,
    /// What to do.
    pub next: String,
    /// The command that makes this the baseline.
    pub update: String,
}

/// One suite for each name, in the order in which they come; no times, so that the same run gives the same bytes.
///
/// # Errors
/// Those of the XML writer.
pub fn junit(report: &str, cases: &[LimitCase]) -> Result<String, XmlError> {
    let mut written = Report::new(report);
    for group in cases.chunk_by(|a, b| a.suite == b.suite) {
        let mut suite = TestSuite::new(group[0].suite.as_str());
        suite.add_test_cases(group.iter().map(test_case));
        written.add_test_suite(suite);
    }
    written.to_string()
}

fn test_case(limit: &LimitCase) -> TestCase {
    let status = match &limit.outcome {
        LimitCaseOutcome::Passed => TestCaseStatus::success(),
        LimitCaseOutcome::Failed(failure) => failed(limit, failure),
        LimitCaseOutcome::NotJudged => skipped(limit),
    };
    let mut case = TestCase::new(limit.title.as_str(), status);
    case.set_classname(limit.suite.as_str());
    case.set_system_out(format!("{}\n{}", limit.why, limit.figures));
    case
}

fn skipped(limit: &LimitCase) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(limit.figures.as_str());
    status
}

fn failed(limit: &LimitCase, failure: &LimitFailure) -> TestCaseStatus {
    let LimitFailure { now, before, next, update } = failure;
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_type("regression").set_message(limit.figures.as_str()).set_description(format!(
        "{}\nlimit: {}\nnow: {now}\nexpected: as the baseline, {before}, as far as chance can tell\nwhy it matters: {}\nnext: {next}\n\
         Meant? `{update}` makes this the baseline.",
        limit.title, limit.id, limit.why,
    ));
    status
}
