//! Columns that tell nothing: one number in all rows, or the numbers of another column.

use hexbench_core::{Channel, Dataset, Hexapod};

use super::sample::Sample;
use crate::inference::examination::{Finding, FindingKind};

/// Fewer rows may be alike by chance, where readings are rounded.
const FEWEST: usize = 12;
/// A column that springs alone miss by no more, over its noise, may be right: it was read to a coarser step than it changes.
const MISSED: f64 = 3.0;

/// Columns of deflections that say nothing where springs say that they should.
pub fn idle_columns(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    let idle = if data.is_absolute() { Vec::new() } else { idle(&columns(data)) };
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
            kind: FindingKind::IdleColumn,
            probability: 1.0,
            rows: Vec::new(),
            size: format!("{rows} rows"),
            text,
            next: format!(
                "write what was read into the column; if that is lost, {empty}: the other columns are diagnosed without it"
            ),
            read_as: Vec::new(),
        }
    }
}

/// Numbers that were read of a channel: their lines and digits.
type Column = (Channel, Vec<(u64, u64)>);

fn columns(data: &Dataset) -> Vec<Column> {
    let mut columns: Vec<Column> = Vec::new();
    for row in &data.observations {
        for (k, channel) in data.channels(row).into_iter().enumerate().filter(|(k, _)| row.is_read(*k)) {
            let place = columns.iter().position(|(known, _)| *known == channel).unwrap_or_else(|| {
                columns.push((channel, Vec::new()));
                columns.len() - 1
            });
            columns[place].1.push((row.line, (row.measured[k] + 0.0).to_bits()));
        }
    }
    columns.retain(|(_, numbers)| numbers.len() >= FEWEST);
    columns
}

/// Columns of one number, and copies of those before them.
fn idle(columns: &[Column]) -> Vec<Idle> {
    let is_one = |numbers: &[(u64, u64)]| numbers.iter().all(|(_, digits)| *digits == numbers[0].1);
    let found = columns.iter().enumerate().filter_map(|(k, (channel, numbers))| {
        let (channel, rows) = (*channel, numbers.len());
        if is_one(numbers) {
            return Some(Idle { channel, copy_of: None, rows });
        }
        let copied = columns[..k].iter().find(|(_, before)| before == numbers)?;
        Some(Idle { channel, copy_of: Some(copied.0), rows })
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
            let found = idle(&columns(&data));
            let of = |channel: Channel| if let Channel::Pose(k) = channel { k } else { 9 };
            let told: Vec<_> = found.iter().map(|i| (of(i.channel), i.copy_of.map(of))).collect();
            assert_eq!(told, expected);
        }
    }
}
