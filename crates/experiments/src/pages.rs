//! What the pages of studies share.

use std::collections::BTreeMap;

use hexbench_core::statistics::Proportion;
use hexbench_report::number::hundredths;
use hexbench_report::{Block, Section, Table};

/// What a row shows in a column.
pub(crate) type ShownOf<'a, T> = &'a dyn Fn(&T) -> String;

/// A table by its columns: what stands above, and what a row shows below.
pub(crate) fn by_columns<T>(rows: impl IntoIterator<Item = T>, columns: &[(&str, ShownOf<'_, T>)]) -> Table {
    let cells = |row: T| columns.iter().map(|(_, cell)| cell(&row)).collect::<Vec<_>>();
    Table::named(columns.iter().map(|(name, _)| *name)).rows(rows.into_iter().map(cells))
}

/// A table with what it says in words.
pub(crate) fn tabled(title: &str, words: &str, table: Table) -> Section {
    Section::new(title).paragraph(words).table(table)
}

/// The commands that make a study again, and one of its campaigns.
pub(crate) fn again(commands: String) -> Section {
    Section::new("Again").with(Block::code(commands)).paragraph(
        "The first writes every trial, the tables and this page; the second writes one campaign as files for `hexbench diagnose`. \
         The same seed gives the same bytes on any number of threads.",
    )
}

/// The option that chooses some ids, once for each; nothing where all are chosen.
pub(crate) fn chosen(option: &str, ids: &[&str], all: &[&str]) -> String {
    let asked = if ids == all { &[] } else { ids };
    asked.iter().fold(String::new(), |words, id| words + &format!(" --{option} {id}"))
}

/// `first (3.1 %)`, `second (4.5 %)`: so many of those with the smallest share, or with the largest.
pub(crate) fn extremes(
    mut shares: Vec<(String, Proportion)>,
    most: bool,
    count: usize,
) -> impl Iterator<Item = String> {
    let by_share = |a: &Proportion, b: &Proportion| a.rate().total_cmp(&b.rate());
    shares.sort_by(|(_, a), (_, b)| if most { by_share(b, a) } else { by_share(a, b) });
    shares.into_iter().take(count).map(|(name, share)| format!("{name} ({} %)", hundredths(share.rate())))
}

/// Records in groups of equal keys, the largest group first.
pub(crate) fn groups<'a, R, K: Ord>(
    records: impl IntoIterator<Item = &'a R>,
    key: impl Fn(&R) -> K,
) -> Vec<(K, Vec<&'a R>)> {
    let mut groups: BTreeMap<K, Vec<&R>> = BTreeMap::new();
    for record in records {
        groups.entry(key(record)).or_default().push(record);
    }
    let mut all: Vec<(K, Vec<&R>)> = groups.into_iter().collect();
    all.sort_by_key(|(_, group)| std::cmp::Reverse(group.len()));
    all
}
