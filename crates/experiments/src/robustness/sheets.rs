//! The tables of the study.

use hexbench_model::inference::verdict::Verdict;
use hexbench_report::Table;
use hexbench_report::number::hundredths;

use super::{RobustnessRecord, Violation, detections};
use crate::pages::{by_columns, groups};
use crate::shares::{bounds, counted, or_dash};
use crate::trial::Outcome;

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

/// Answers that are wrong about the machine, in groups, the largest first.
pub fn mistakes_table(records: &[RobustnessRecord]) -> Table {
    let header = ["fault", "machine", "answer", "findings", "trials", "examples: trial, hidden, plan"];
    let mut table = Table::named(header).words_in(1).words_in(2).words_in(3).words_in(5);
    let wrong = records.iter().filter(|r| r.outcome() == Outcome::Wrong);
    let key = |r: &RobustnessRecord| (r.fault, r.is_clean(), mistake(r), r.findings.join(", "));
    for ((fault, is_clean, answer, findings), trials) in groups(wrong, key).into_iter().take(MOST_GROUPS) {
        let examples: Vec<String> = trials.iter().take(EXAMPLES).map(|r| example(r)).collect();
        let machine = if is_clean { "clean" } else { "one effect" };
        let words = [fault.to_owned(), machine.to_owned(), answer, findings];
        table.row(words.into_iter().chain([trials.len().to_string(), examples.join("; ")]));
    }
    table
}

/// Verdict, and what is wrong with what it names.
fn mistake(r: &RobustnessRecord) -> String {
    let verdict = r.answer.verdict.word();
    let false_names: Vec<&str> =
        r.answer.added.iter().map(String::as_str).filter(|id| !r.answer.contains(id)).collect();
    if false_names.is_empty() { verdict.to_owned() } else { format!("{verdict}: {}", false_names.join("+")) }
}

fn example(r: &RobustnessRecord) -> String {
    format!("{:04} ({}, {})", r.index, r.answer.hidden_words(), r.answer.plan.name())
}
