//! The tables of the study.

use hexbench_core::statistics::Proportion;
use hexbench_report::Table;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use super::{DiscoveryRecord, LawFate};
use crate::shares::{counted, percent};

/// Limits between which stated probabilities are gathered.
const STATED: [f64; 5] = [0.0, 0.5, 0.95, 0.99, 1.0];

/// One line for each effect outside the catalogue, and for what is hidden in the others.
pub(super) fn fates(records: &[DiscoveryRecord]) -> Table {
    let mut table = Table::named(["hidden", "campaigns"].into_iter().chain(LawFate::ALL.map(LawFate::word)));
    let outside = REGISTRY.iter().filter(|e| e.shows == Shows::Outside).map(|e| (e.id, Some(e.id)));
    for (title, id) in outside {
        push(&mut table, title, &records.iter().filter(|r| r.outside() == id).collect::<Vec<_>>());
    }
    let listed = |r: &&DiscoveryRecord| r.outside().is_none() && !r.hidden.is_empty();
    push(&mut table, "an effect of the catalogue", &records.iter().filter(listed).collect::<Vec<_>>());
    push(&mut table, "nothing", &records.iter().filter(|r| r.hidden.is_empty()).collect::<Vec<_>>());
    table
}

fn push(table: &mut Table, title: &str, records: &[&DiscoveryRecord]) {
    if records.is_empty() {
        return;
    }
    let count = |fate: LawFate| records.iter().filter(|r| r.fate() == fate).count().to_string();
    table.row([title.to_owned(), records.len().to_string()].into_iter().chain(LawFate::ALL.map(count)));
}

/// By distance: laws that the grammar can say.
pub(super) fn distances(records: &[DiscoveryRecord]) -> Table {
    let mut table = Table::named(["distance", "right", "right or equivalent", "wrong"]);
    for [low, high] in [[10.0, 20.0], [20.0, 35.0], [35.0, 60.1]] {
        let within =
            |r: &&DiscoveryRecord| r.is_sayable() && r.distance.is_some_and(|d| (low..high).contains(&d));
        let own: Vec<&DiscoveryRecord> = records.iter().filter(within).collect();
        let share = |fates: &[LawFate]| counted(Proportion::count(own.iter(), |r| fates.contains(&r.fate())));
        table.row([
            format!("{low:.0} to {high:.0}"),
            share(&[LawFate::Right]),
            share(&[LawFate::Right, LawFate::Equivalent]),
            share(&[LawFate::Wrong]),
        ]);
    }
    table
}

/// Stated probability of a law against what came true.
pub(super) fn stated(records: &[DiscoveryRecord]) -> Table {
    let mut table = Table::named([
        "stated probability of a law",
        "campaigns",
        "something outside the catalogue hidden %",
    ]);
    for pair in STATED.windows(2) {
        let last = pair[1] >= 1.0;
        let within = |r: &&DiscoveryRecord| r.probability >= pair[0] && (last || r.probability < pair[1]);
        let own: Vec<&DiscoveryRecord> = records.iter().filter(within).collect();
        let true_share = Proportion::count(own.iter(), |r| r.outside().is_some());
        table.row([format!("{} to {}", pair[0], pair[1]), own.len().to_string(), percent(true_share)]);
    }
    table
}
