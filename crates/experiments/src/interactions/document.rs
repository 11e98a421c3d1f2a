//! The study as a page.

use std::collections::BTreeMap;

use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section, Table};

use super::protocol::Interactions;
use super::trial::{FAMILY, InteractionRecord, LARGEST_PARAMETER_ERROR, LARGEST_STIFFNESS_ERROR, PLAN};
use crate::shares::dash;

/// Sets listed one by one.
const LISTED: usize = 60;
/// The same sets fitted by the model before its terms shared one equilibrium: joint stiffness relieved the springs alone, friction
/// stood before every other law of a leg, bodies in series saw the load as stated.
const BEFORE: &str = include_str!("before.csv");

/// Errors of a set by the earlier model.
#[derive(Debug, Clone, Copy)]
struct Before {
    stiffness: f64,
    parameter: f64,
    within: bool,
}

/// The page.
pub fn page(study: &Interactions) -> Page {
    let again = format!("hexbench validate interactions --seed {}", study.protocol.seed);
    let before = before();
    Page::new("Effects beside each other")
        .with(introduction(study).detail())
        .with(Section::new("In short").table(summary(study, &before)))
        .with(Section::new("Beyond their bounds").paragraph(BEYOND).table(beyond(study)).unless_empty())
        .with(
            Section::new("Before and after")
                .remark("the sets with the largest errors before")
                .table(compared(study, &before)),
        )
        .with(study.unanswered())
        .with(Section::new("Run it again").with(Block::code(again)).detail())
}

fn introduction(study: &Interactions) -> Section {
    Section::lead()
        .paragraph(written_by("hexbench validate interactions --markdown FILE"))
        .paragraph(format!(
            "Each of {} sets of effects (all of those that deflections show alone, every pair of them, and drawn triples) acts on a \
             machine of the family {FAMILY} with leg stiffnesses of its own, measured by a plan of the make {} without noise, at usual \
             and at ten times usual size (seed {}). The world finds its equilibrium at finite deflection; the model is told which \
             effects are there and fits springs, sizes and shapes.",
            study.protocol.sets.len(),
            PLAN.name(),
            study.protocol.seed,
        ))
        .paragraph(format!(
            "A leg stiffness may be off by {:.1} %, a parameter of an effect by {:.1} %, a number that hardly shows by what the second \
             order of the deflection does to it (`std |d|`, `interactions/second_order.rs`). Errors of a parameter are relative to the largest \
             of its kind in the same effect. Before: the same sets by a model in which joint stiffness relieved the legs through their springs alone, \
             friction stood before every other law of a leg, and bodies in series saw the load as it was stated.",
            100.0 * LARGEST_STIFFNESS_ERROR,
            100.0 * LARGEST_PARAMETER_ERROR,
        ))
}

const BEYOND: &str = "A leg without force rests anywhere within its play; legs of the model push or pull. Where readings have such a leg, play and \
                      what stands beside the legs are not told exactly.";

fn before() -> BTreeMap<String, Before> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let [effects, size, stiffness, parameter, within] = cells.as_slice() else { return None };
        let before = Before {
            stiffness: stiffness.parse().ok()?,
            parameter: parameter.parse().ok()?,
            within: *within == "1",
        };
        Some((format!("{effects} x{size}"), before))
    };
    BEFORE.lines().skip(1).filter_map(row).collect()
}

fn key(r: &InteractionRecord) -> String {
    format!("{} x{}", r.effects.join(" + "), r.size)
}

fn summary(study: &Interactions, before: &BTreeMap<String, Before>) -> Table {
    let mut table = Table::named([
        "effects",
        "size",
        "sets",
        "within",
        "before",
        "stiffness, worst",
        "before",
        "parameter, worst",
        "before",
    ]);
    for (count, words) in [(1, "one"), (2, "two"), (3, "three")] {
        for size in [1.0, 10.0] {
            let own: Vec<&InteractionRecord> = study
                .records
                .iter()
                .filter(|r| r.effects.len() == count && r.size.total_cmp(&size).is_eq())
                .collect();
            let was: Vec<Before> = own.iter().filter_map(|r| before.get(&key(r)).copied()).collect();
            let worst = |errors: &mut dyn Iterator<Item = f64>| {
                errors.reduce(f64::max).map_or_else(dash, error_in_percent)
            };
            table.row([
                words.to_owned(),
                format!("x{size}"),
                own.len().to_string(),
                own.iter().filter(|r| r.holds()).count().to_string(),
                was.iter().filter(|b| b.within).count().to_string(),
                worst(&mut own.iter().map(|r| r.stiffness.error)),
                worst(&mut was.iter().map(|b| b.stiffness)),
                worst(&mut own.iter().map(|r| r.parameter.error)),
                worst(&mut was.iter().map(|b| b.parameter)),
            ]);
        }
    }
    table
}

fn beyond(study: &Interactions) -> Table {
    let mut table = Table::named([
        "effects",
        "size",
        "stiffness",
        "allowed",
        "parameter",
        "allowed",
        "left open",
        "readings with a leg in its play",
        "which",
    ])
    .words_in(8);
    for r in study.broken() {
        let numbers = [r.stiffness.error, r.stiffness.bound, r.parameter.error, r.parameter.bound]
            .map(error_in_percent);
        let start = [r.effects.join(" + "), format!("x{}", r.size)];
        let rest = [r.open.to_string(), r.resting.to_string(), r.name.clone()];
        table.row(start.into_iter().chain(numbers).chain(rest));
    }
    table
}

fn compared(study: &Interactions, before: &BTreeMap<String, Before>) -> Table {
    let excess =
        |b: &Before| (b.stiffness / LARGEST_STIFFNESS_ERROR).max(b.parameter / LARGEST_PARAMETER_ERROR);
    let mut all: Vec<(&InteractionRecord, &Before)> =
        study.records.iter().filter_map(|r| Some((r, before.get(&key(r))?))).collect();
    all.sort_by(|a, b| excess(b.1).total_cmp(&excess(a.1)));
    let mut table =
        Table::named(["effects", "size", "stiffness before", "after", "parameter before", "after"]);
    for (r, b) in all.into_iter().take(LISTED) {
        let numbers = [b.stiffness, r.stiffness.error, b.parameter, r.parameter.error].map(error_in_percent);
        table.row([r.effects.join(" + "), format!("x{}", r.size)].into_iter().chain(numbers));
    }
    table
}

fn error_in_percent(share: f64) -> String {
    let p = 100.0 * share;
    if p >= 0.01 { format!("{p:.3} %") } else { format!("{p:.1e} %") }
}
