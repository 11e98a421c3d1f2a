//! The tables of the study.

use hexbench_core::statistics::Proportion;
use hexbench_report::Table;
use hexbench_truth::campaign::CaseKind;

use super::false_alarms::{RANGES, blamed, is_blamed, is_of_size, of_kind};
use super::record::SCENE;
use super::{MisreadFate, MisreadGroup, MisreadRecord};
use crate::shares::{bounds, percent};

/// Most false alarms that get a line.
const MOST_ALARMS: usize = 40;
/// Most refusals that get a line.
const MOST_REFUSALS: usize = 20;

/// One line for each misstatement.
pub fn misstatements(records: &[MisreadRecord]) -> Table {
    let header = ["misstatement", "what the author did", "right words"].into_iter().chain(figures());
    let mut table = Table::named(header.chain(["most often"])).words_in(1).words_in(2).words_in(12);
    for group in MisreadGroup::of_each_misstatement(records) {
        let Some(entry) = group.records.first().and_then(|r| r.entry()) else { continue };
        let words = [entry.id.to_owned(), entry.sentence.to_owned(), right(entry.causes, entry.effects)];
        table.row(words.into_iter().chain(cells(&group)).chain([group.said_most()]));
    }
    table
}

fn right(causes: &[&str], effects: &[&str]) -> String {
    causes.iter().chain(effects).copied().collect::<Vec<_>>().join(", ")
}

/// One line for each group.
pub fn groups(title: &'static str, groups: &[MisreadGroup<'_>]) -> Table {
    let mut table = Table::named(std::iter::once(title).chain(figures()));
    for group in groups {
        table.row(std::iter::once(group.name.clone()).chain(cells(group)));
    }
    table
}

fn figures() -> impl Iterator<Item = &'static str> {
    ["campaigns", "matters", "looks right"].into_iter().chain(MisreadFate::ALL.map(MisreadFate::words))
}

fn cells(group: &MisreadGroup<'_>) -> impl Iterator<Item = String> {
    let count = |p: Proportion| p.hits.to_string();
    let counts = [group.records.len().to_string(), count(group.matters()), count(group.looks_right())];
    counts.into_iter().chain(MisreadFate::ALL.map(|fate| percent(group.share(fate))))
}

/// Sound campaigns whose files are blamed, by kind and size of the effects.
pub fn false_alarms(records: &[MisreadRecord]) -> Table {
    let sizes = RANGES.map(|(name, _)| name);
    let mut table = Table::named(["kind"].into_iter().chain(sizes).chain(["all", "95 % bounds"]));
    let cell = |p: Proportion| if p.of == 0 { "-".to_owned() } else { format!("{} of {}", p.hits, p.of) };
    let mut row = |name: &str, of_sizes: [Proportion; 3], all: Proportion| {
        table.row([name.to_owned()].into_iter().chain(of_sizes.map(cell)).chain([cell(all), bounds(all)]));
    };
    for kind in CaseKind::ALL.map(CaseKind::name).into_iter().chain([SCENE]) {
        let of_sizes = RANGES.map(|(_, range)| of_kind(records, kind, Some(range)));
        row(kind, of_sizes, of_kind(records, kind, None));
    }
    let of_sizes = RANGES.map(|(_, range)| blamed(records, |r| is_of_size(r, range)));
    row("all", of_sizes, blamed(records, |_| true));
    table
}

/// Sound campaigns whose files are blamed, one by one.
pub fn alarms(records: &[MisreadRecord]) -> Table {
    let mut table = Table::named(["trial", "hidden", "family", "plan", "findings"]).words_in(4);
    for r in records.iter().filter(|r| is_blamed(r)).take(MOST_ALARMS) {
        let of = &r.campaign;
        table.row([&r.name, &of.hidden, &of.family, &of.plan, &r.findings.join(", ")]);
    }
    table
}

/// Why files are refused, one line for each misstatement.
pub fn refusals(records: &[MisreadRecord]) -> Table {
    let mut table = Table::named(["misstatement", "trials", "what is said first"]).words_in(2);
    for group in MisreadGroup::of_each_misstatement(records) {
        let refused: Vec<_> = group.records.iter().filter(|r| r.verdict.is_none()).collect();
        if let Some(first) = refused.first().filter(|_| table.rows.len() < MOST_REFUSALS) {
            table.row([group.name.clone(), refused.len().to_string(), first.refusal.clone()]);
        }
    }
    table
}
