//! Columns that are not as they should be.

use super::bench::{FEW, Share};
use super::fate::Fate;
use super::table::Table;

/// Every column in every wrong way.
pub(super) fn columns(share: Share) -> Vec<Fate> {
    let table = &FEW.readings;
    let changes: [fn(&Table, usize) -> Table; 6] =
        [left_out, doubled, misspelled, in_capitals, moved, one_more];
    let cases: Vec<_> =
        changes.iter().flat_map(|change| (0..table.names.len()).map(move |k| (change, k))).collect();
    share.each(&cases, |(change, column)| FEW.fit(change(table, *column).text()))
}

fn edited(table: &Table, edit: impl Fn(&mut Vec<String>)) -> Table {
    let mut table = table.clone();
    edit(&mut table.names);
    table.rows.iter_mut().for_each(edit);
    table
}

fn left_out(table: &Table, column: usize) -> Table {
    edited(table, |cells| drop(cells.remove(column)))
}

fn doubled(table: &Table, column: usize) -> Table {
    edited(table, |cells| cells.push(cells[column].clone()))
}

/// The first two letters exchanged.
fn misspelled(table: &Table, column: usize) -> Table {
    let mut table = table.clone();
    let mut letters: Vec<char> = table.names[column].chars().collect();
    letters.swap(0, 1);
    table.names[column] = letters.into_iter().collect();
    table
}

fn in_capitals(table: &Table, column: usize) -> Table {
    let mut table = table.clone();
    table.names[column].make_ascii_uppercase();
    table
}

fn moved(table: &Table, column: usize) -> Table {
    edited(table, |cells| {
        let cell = cells.remove(column);
        cells.insert(0, cell);
    })
}

/// A column of words after this one.
fn one_more(table: &Table, column: usize) -> Table {
    let mut table = edited(table, |cells| cells.insert(column, "good".into()));
    table.names[column] = "remark".into();
    table
}
