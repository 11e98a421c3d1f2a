//! How often each kind of finding is there when it should be, and when it should not.

use std::collections::BTreeSet;

use hexbench_core::statistics::Proportion;
use hexbench_truth::laboratory;

use super::RobustnessRecord;

/// One kind of finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Detection {
    /// Word of `findings[].kind`.
    pub kind: String,
    /// Trials of faults that are best called so, with such a finding.
    pub found: Proportion,
    /// Trials of faults that must not be called so, with such a finding.
    pub false_alarms: Proportion,
    /// The same in the control alone.
    pub in_control: Proportion,
}

/// One line for each kind that was told or should have been.
pub fn detections(records: &[RobustnessRecord]) -> Vec<Detection> {
    let due = records.iter().filter_map(|r| best_word(r));
    let kinds: BTreeSet<&str> =
        records.iter().flat_map(|r| r.findings.iter().map(String::as_str)).chain(due).collect();
    kinds.into_iter().map(|kind| detection(kind, records)).collect()
}

fn detection(kind: &str, records: &[RobustnessRecord]) -> Detection {
    let is_called = |r: &&RobustnessRecord| laboratory::entry(r.fault).is_some_and(|e| e.is_called(kind));
    let is_found = |r: &&RobustnessRecord| r.finds(kind);
    let share = |among: &dyn Fn(&&RobustnessRecord) -> bool| {
        Proportion::count(records.iter().filter(|r| among(r)), is_found)
    };
    Detection {
        kind: kind.to_owned(),
        found: share(&|r| best_word(r) == Some(kind)),
        false_alarms: share(&|r| !is_called(r)),
        in_control: share(&|r| r.fault == laboratory::CAREFUL.id),
    }
}

/// The word by which the fault of a trial is best called.
fn best_word(record: &RobustnessRecord) -> Option<&'static str> {
    laboratory::entry(record.fault)?.findings.first().copied()
}
