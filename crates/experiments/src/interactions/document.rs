//! The study as a page.

use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section, Table};

use super::protocol::Interactions;
use super::trial::{FAMILY, InteractionRecord, LARGEST_PARAMETER_ERROR, LARGEST_STIFFNESS_ERROR, PLAN};

/// Sets listed one by one: those nearest to their bounds, or furthest beyond.
const LISTED: usize = 40;

/// The page.
pub fn page(study: &Interactions) -> Page {
    let again = format!("hexbench validate interactions --seed {}", study.protocol.seed);
    let failures = study.failures.iter().map(|(name, why)| format!("{name}: {why}"));
    Page::new("Effects beside each other")
        .with(introduction(study).detail())
        .with(Section::new("In short").table(summary(study)))
        .with(Section::new("The largest errors").table(worst(study)))
        .with(Section::new("Not made or not fitted").list(failures).unless_empty())
        .with(Section::new("Run it again").with(Block::code(again)).detail())
}

fn introduction(study: &Interactions) -> Section {
    Section::lead()
        .paragraph(written_by("hexbench validate interactions --markdown FILE"))
        .paragraph(format!(
            "Each of {} sets of effects (all of those that deflections show alone, every pair of them, and drawn triples) acts on a \
             machine of the family {FAMILY} with leg stiffnesses of its own, measured by a plan of the make {} without noise, at usual \
             and at ten times usual size (seed {}). The world finds its equilibrium at finite deflection; the model is told which effects are there and \
             fits springs, sizes and shapes. A leg stiffness may be off by {:.1} %, a parameter of an effect by {:.1} %, both or by what \
             the second order of the deflection allows for a number that hardly shows (`std |d|` as in `recovery/noiseless.rs`).",
            study.protocol.sets.len(),
            PLAN.name(),
            study.protocol.seed,
            100.0 * LARGEST_STIFFNESS_ERROR,
            100.0 * LARGEST_PARAMETER_ERROR,
        ))
}

fn summary(study: &Interactions) -> Table {
    let mut table = Table::named([
        "effects",
        "size",
        "sets",
        "within",
        "stiffness, median",
        "worst",
        "parameter, median",
        "worst",
    ]);
    for (count, words) in [(1, "one"), (2, "two"), (3, "three")] {
        for size in [1.0, 10.0] {
            let own = study.records.iter().filter(|r| r.effects.len() == count && r.size == size);
            let own: Vec<&InteractionRecord> = own.collect();
            let stiffness = median_and_worst(own.iter().map(|r| r.stiffness.error).collect());
            let parameter = median_and_worst(own.iter().map(|r| r.parameter.error).collect());
            let held = own.iter().filter(|r| r.holds()).count();
            let start = [words.to_owned(), format!("x{size}"), own.len().to_string(), held.to_string()];
            table.row(start.into_iter().chain(stiffness).chain(parameter));
        }
    }
    table
}

fn median_and_worst(mut errors: Vec<f64>) -> [String; 2] {
    errors.sort_by(f64::total_cmp);
    [errors.get(errors.len() / 2), errors.last()].map(|e| e.map_or("-".to_owned(), |e| percent(*e)))
}

fn worst(study: &Interactions) -> Table {
    let mut all: Vec<&InteractionRecord> = study.records.iter().collect();
    let excess = |r: &InteractionRecord| {
        [r.stiffness, r.parameter].map(|b| b.error / b.bound).into_iter().fold(0.0, f64::max)
    };
    all.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let mut table =
        Table::named(["effects", "size", "stiffness", "allowed", "parameter", "allowed", "which"]).words_in(6);
    for r in all.into_iter().take(LISTED) {
        let numbers = [r.stiffness.error, r.stiffness.bound, r.parameter.error, r.parameter.bound].map(percent);
        let open = if r.open > 0 { format!("{} ({} left open)", r.name, r.open) } else { r.name.clone() };
        let start = [r.effects.join(" + "), format!("x{}", r.size)];
        table.row(start.into_iter().chain(numbers).chain([open]));
    }
    table
}

fn percent(share: f64) -> String {
    let p = 100.0 * share;
    if p >= 0.01 { format!("{p:.3} %") } else { format!("{p:.1e} %") }
}
