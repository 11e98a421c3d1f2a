//! The tables of the study.

use hexbench_model::inference::verdict::Verdict;
use hexbench_report::Table;
use hexbench_report::number::hundredths;

use super::{RobustnessRecord, Violation, detections, mistakes};
use crate::pages::by_columns;
use crate::shares::{bounds, counted, or_dash};

/// Most groups of wrong answers that get a line.
const MOST_GROUPS: usize = 25;
/// Trials named for each group.
const EXAMPLES: usize = 3;

/// One line for each fault, shares in percent.
pub fn violations(records: &[RobustnessRecord]) -> Table {
    by_columns(
        Violation::of_each(records),
        &[
            ("what the laboratory does", &|v| v.fault.title.to_owned()),
            ("clean right", &|v| hundredths(v.clean_right().rate())),
            ("effect right", &|v| hundredths(v.effect_right().rate())),
            ("named falsely", &|v| hundredths(v.falsely_named().rate())),
            ("outside", &|v| hundredths(v.outside().rate())),
            ("fault told", &|v| hundredths(v.reported().rate())),
            ("other told", &|v| hundredths(v.other_reported().rate())),
            ("stiffness in 95 %", &|v| hundredths(v.stiffness().rate())),
        ],
    )
}

/// The same with counts and exact bounds, and what the first table leaves out.
pub fn counts(records: &[RobustnessRecord]) -> Table {
    by_columns(
        Violation::of_each(records),
        &[
            ("fault", &|v| v.fault.id.to_owned()),
            ("clean right", &|v| counted(v.clean_right())),
            ("effect right", &|v| counted(v.effect_right())),
            ("named falsely", &|v| counted(v.falsely_named())),
            ("fault told", &|v| counted(v.reported())),
            ("other told", &|v| counted(v.other_reported())),
            ("stiffness in 95 %", &|v| counted(v.stiffness())),
            ("of all answers", &|v| counted(v.any_stiffness())),
            ("held-out chi2", &|v| or_dash(v.held_out(), |x| format!("{x:.2}"))),
        ],
    )
}

/// Verdicts on clean machines and on those with an effect: `clean/effect`.
pub fn verdicts(records: &[RobustnessRecord]) -> Table {
    let all = [
        Verdict::Adequate,
        Verdict::Measurement,
        Verdict::Named,
        Verdict::Ambiguous,
        Verdict::Undecided,
        Verdict::Outside,
    ];
    let mut table = Table::named(std::iter::once("fault").chain(all.map(Verdict::word)));
    for v in Violation::of_each(records) {
        let cell = |verdict| {
            let [clean, effect] = v.verdicts(verdict);
            format!("{clean}/{effect}")
        };
        table.row(std::iter::once(v.fault.id.to_owned()).chain(all.map(cell)));
    }
    table
}

/// How often each kind of finding is there when it should be, and when it should not.
pub fn findings(records: &[RobustnessRecord]) -> Table {
    by_columns(
        detections(records),
        &[
            ("finding", &|d| d.kind.clone()),
            ("found %", &|d| hundredths(d.found.rate())),
            ("of", &|d| d.found.of.to_string()),
            ("95 % bounds", &|d| bounds(d.found)),
            ("false alarms %", &|d| hundredths(d.false_alarms.rate())),
            ("of", &|d| d.false_alarms.of.to_string()),
            ("95 % bounds", &|d| bounds(d.false_alarms)),
            ("in control", &|d| format!("{} of {}", d.in_control.hits, d.in_control.of)),
        ],
    )
}

/// The largest groups of wrong answers.
pub fn mistakes_table(records: &[RobustnessRecord]) -> Table {
    let header = ["fault", "machine", "answer", "findings", "trials", "examples: trial, hidden, plan"];
    let mut table = Table::named(header).words_in(1).words_in(2).words_in(3).words_in(5);
    for group in mistakes(records).iter().take(MOST_GROUPS) {
        let examples: Vec<String> = group.trials.iter().take(EXAMPLES).map(|r| example(r)).collect();
        let machine = if group.is_clean { "clean" } else { "one effect" };
        let words =
            [group.fault.to_owned(), machine.to_owned(), group.answer.clone(), group.findings.clone()];
        table.row(words.into_iter().chain([group.trials.len().to_string(), examples.join("; ")]));
    }
    table
}

fn example(r: &RobustnessRecord) -> String {
    format!("{:04} ({}, {})", r.index, r.answer.hidden_words(), r.answer.plan.name())
}
