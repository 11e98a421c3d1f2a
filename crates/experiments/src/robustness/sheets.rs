//! The tables of the study.

use hexbench_core::statistics::Proportion;
use hexbench_model::inference::verdict::Verdict;
use hexbench_report::Table;
use hexbench_report::number::hundredths;

use super::{RobustnessRecord, Violation, detections, mistakes};
use crate::shares::{bounds, counted, or_dash};

/// Most groups of wrong answers that get a line.
const MOST_GROUPS: usize = 25;
/// Trials named for each group.
const EXAMPLES: usize = 3;

/// One line for each fault, shares in percent.
pub fn violations(records: &[RobustnessRecord]) -> Table {
    let mut table = Table::named([
        "what the laboratory does",
        "clean right",
        "effect right",
        "named falsely",
        "outside",
        "fault told",
        "other told",
        "stiffness in 95 %",
    ]);
    for v in Violation::of_each(records) {
        let shares = [
            v.clean_right(),
            v.effect_right(),
            v.falsely_named(),
            v.outside(),
            v.reported(),
            v.other_reported(),
            v.stiffness(),
        ];
        table.row(std::iter::once(v.fault.title.to_owned()).chain(shares.map(|p| hundredths(p.rate()))));
    }
    table
}

/// The same with counts and exact bounds, and what the first table leaves out.
pub fn counts(records: &[RobustnessRecord]) -> Table {
    let mut table = Table::named([
        "fault",
        "clean right",
        "effect right",
        "named falsely",
        "fault told",
        "other told",
        "stiffness in 95 %",
        "of all answers",
        "held-out chi2",
    ]);
    for v in Violation::of_each(records) {
        let shares = [
            v.clean_right(),
            v.effect_right(),
            v.falsely_named(),
            v.reported(),
            v.other_reported(),
            v.stiffness(),
            v.any_stiffness(),
        ];
        let held_out = or_dash(v.held_out(), |x| format!("{x:.2}"));
        table.row(std::iter::once(v.fault.id.to_owned()).chain(shares.map(counted)).chain([held_out]));
    }
    table
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
    let mut table = Table::named([
        "finding",
        "found %",
        "of",
        "95 % bounds",
        "false alarms %",
        "of",
        "95 % bounds",
        "in control",
    ]);
    for d in detections(records) {
        let cells = |p: Proportion| [hundredths(p.rate()), p.of.to_string(), bounds(p)];
        let control = format!("{} of {}", d.in_control.hits, d.in_control.of);
        let row = std::iter::once(d.kind).chain(cells(d.found)).chain(cells(d.false_alarms));
        table.row(row.chain([control]));
    }
    table
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
