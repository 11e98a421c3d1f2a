//! Columns that tell nothing: one number in all rows, or the numbers of another column.

use hexbench_core::{Channel, Dataset, Hexapod};

use super::sample::Sample;
use crate::inference::examination::{Finding, FindingKind};

/// Fewer rows may be alike by chance, where readings are rounded.
const FEWEST: usize = 12;
/// A column that springs alone miss by no more, over its noise, may be right: it was read to a coarser step than it changes.
const MISSED: f64 = 3.0;

/// Columns of deflections that say nothing where springs say that they should.
pub(crate) fn idle_columns(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    if data.is_absolute() {
        return Vec::new();
    }
    let idle = idle(data);
    if idle.is_empty() {
        return Vec::new();
    }
    let Some(sample) = Sample::new(hexapod, data) else { return Vec::new() };
    let is_missed = |column: &&Idle| sample.level_of(column.channel).is_some_and(|level| level > MISSED);
    let name = |channel: Channel| channel.column(&hexapod.sensors, data.measurand);
    idle.iter().filter(is_missed).map(|column| column.finding(&name)).collect()
}

/// A column that tells nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Idle {
    channel: Channel,
    /// The column whose numbers it has; none where it has one number.
    copy_of: Option<Channel>,
    rows: usize,
}

impl Idle {
    fn finding(self, name: &impl Fn(Channel) -> String) -> Finding {
        let (column, rows) = (name(self.channel), self.rows);
        let (text, empty) = match self.copy_of.map(name) {
            None => (
                format!(
                    "{column} is the same number in all {rows} rows, although the platform moves: nothing was read"
                ),
                format!("leave the cells of {column} empty"),
            ),
            Some(other) => (
                format!(
                    "{other} and {column} are the same numbers in all {rows} rows: one is a copy of the other"
                ),
                format!("leave the cells of the copy empty, {other} or {column}"),
            ),
        };
        Finding {
            size: format!("{rows} rows"),
            text,
            next: format!(
                "write what was read into the column; if that is lost, {empty}: the other columns are diagnosed without it"
            ),
            ..Finding::of(FindingKind::IdleColumn)
        }
    }
}

/// A column of the file, as far as it has been read.
struct Column {
    channel: Channel,
    /// The digits of its first number.
    first: u64,
    is_one_number: bool,
    rows: usize,
}

/// Columns of one number, and copies of those before them.
fn idle(data: &Dataset) -> Vec<Idle> {
    let mut columns: Vec<Column> = Vec::new();
    // Columns, by their places, that have had the same numbers so far.
    let mut alike: Vec<[usize; 2]> = Vec::new();
    let mut row: Vec<Option<u64>> = Vec::new();
    for (number, observations) in data.rows().enumerate() {
        row.fill(None);
        for o in observations {
            for (k, channel) in data.channels(o).into_iter().enumerate().filter(|(k, _)| o.is_read(*k)) {
                let digits = (o.measured[k] + 0.0).to_bits();
                let known = columns.iter().position(|column| column.channel == channel);
                let place = known.unwrap_or(columns.len());
                if known.is_none() {
                    columns.push(Column { channel, first: digits, is_one_number: true, rows: 0 });
                    row.push(None);
                    // A column that begins later has an empty cell where the others have a number.
                    alike.extend((0..place).filter(|_| number == 0).map(|before| [before, place]));
                }
                let column = &mut columns[place];
                column.is_one_number &= column.first == digits;
                column.rows += 1;
                row[place] = Some(digits);
            }
        }
        alike.retain(|&[one, other]| row[one] == row[other]);
    }
    let found =
        columns.iter().enumerate().filter(|(_, column)| column.rows >= FEWEST).filter_map(|(k, column)| {
            let Column { channel, is_one_number, rows, .. } = *column;
            let copied = alike.iter().find(|[_, copy]| !is_one_number && *copy == k);
            let copy_of = copied.map(|[of, _]| columns[*of].channel);
            (is_one_number || copy_of.is_some()).then_some(Idle { channel, copy_of, rows })
        });
    found.collect()
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn columns_of_one_number_and_copies_are_seen_in_twelve_rows() {
        let (_, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let row = data.observations[0];
        let rows = |n: u64| {
            (0..n).map(|k| hexbench_core::Observation {
                line: k + 2,
                measured: [1.0, k as f64, k as f64, 0.5 * k as f64, -(k as f64), 3.0],
                ..row
            })
        };
        for (n, expected) in [(11, vec![]), (12, vec![(0, None), (2, Some(1)), (5, None)])] {
            data.observations = rows(n).collect();
            let found = idle(&data);
            let of = |channel: Channel| if let Channel::Pose(k) = channel { k } else { 9 };
            let told: Vec<_> = found.iter().map(|i| (of(i.channel), i.copy_of.map(of))).collect();
            assert_eq!(told, expected);
        }
    }
}
