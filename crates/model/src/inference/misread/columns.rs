//! Columns that tell nothing: one number in all rows or from some row on, or the numbers of another column.

use std::cell::LazyCell;

use hexbench_core::{Channel, Dataset, Hexapod, LineRange};

use super::sample::{Sample, like};
use crate::inference::examination::{Finding, FindingKind, not_entered};

/// Fewer rows may be alike by chance, where readings are rounded.
const FEWEST: usize = 12;
/// Chance of a stretch of equal numbers, from how often neighbors in the rest of the column are equal, below which nothing was read in it:
/// numbers that are rounded are equal often.
const BY_CHANCE: f64 = 1e-6;
/// A column that springs alone miss by no more, over its noise, may be right: it was read to a coarser step than it changes.
const MISSED: f64 = 3.0;

/// Columns of deflections that say nothing where springs say that they should.
pub(crate) fn idle_columns(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    if data.is_absolute() {
        return Vec::new();
    }
    if let Some(found) = not_entered(data).filter(|found| found.kind.is_of_file()) {
        return vec![found];
    }
    let idle = idle(data);
    if idle.is_empty() {
        return Vec::new();
    }
    let whole = LazyCell::new(|| Sample::new(hexapod, data));
    let is_missed = |column: &&Idle| {
        let level = |sample: &Sample| sample.level_of(column.channel);
        let level = match column.stretch {
            None => whole.as_ref().and_then(level),
            Some(lines) => Sample::new(hexapod, &within(data, lines)).as_ref().and_then(level),
        };
        level.is_some_and(|level| level > MISSED)
    };
    let name = |channel: Channel| channel.column(&hexapod.sensors, data.measurand);
    idle.iter().filter(is_missed).map(|column| column.finding(&name)).collect()
}

/// The rows in these lines.
fn within(data: &Dataset, lines: LineRange) -> Dataset {
    let observations = data.observations.iter().filter(|o| lines.contains(o.line)).copied().collect();
    Dataset { observations, ..like(data) }
}

/// A column that tells nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Idle {
    channel: Channel,
    /// The column whose numbers it has; none where it has one number.
    copy_of: Option<Channel>,
    /// Lines in which it tells nothing; none where all of it does.
    stretch: Option<LineRange>,
    rows: usize,
}

impl Idle {
    fn finding(self, name: &impl Fn(Channel) -> String) -> Finding {
        let (column, rows) = (name(self.channel), self.rows);
        let (text, empty) = match self.copy_of.map(name) {
            _ if let Some([first, last]) = self.stretch.map(LineRange::ends) => (
                format!(
                    "{column} is the same number in {rows} rows in succession, lines {first} to {last}, although the platform moves: \
                     nothing was read there"
                ),
                format!("leave the cells of {column} empty in these lines"),
            ),
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
                "write what was read into the column; if that is lost, {empty}: the other numbers are diagnosed without it"
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
    /// Neighbors that are equal.
    equal: usize,
    /// The digits of its last number, and the rows in succession that have had it.
    last: Stretch,
    longest: Stretch,
}

/// Rows in succession with one number.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    digits: u64,
    lines: [u64; 2],
    rows: usize,
}

impl Column {
    fn new(channel: Channel, digits: u64, line: u64) -> Self {
        let last = Stretch { digits, lines: [line; 2], rows: 0 };
        Self { channel, first: digits, is_one_number: true, rows: 0, equal: 0, last, longest: last }
    }

    fn read(&mut self, digits: u64, line: u64) {
        self.is_one_number &= self.first == digits;
        self.equal += usize::from(self.rows > 0 && self.last.digits == digits);
        self.rows += 1;
        if self.last.digits != digits {
            self.last = Stretch { digits, lines: [line; 2], rows: 0 };
        }
        self.last.rows += 1;
        self.last.lines[1] = line;
        if self.last.rows > self.longest.rows {
            self.longest = self.last;
        }
    }

    /// The longest stretch of one number, where chance gives none as long.
    fn stretch(&self) -> Option<Stretch> {
        let Stretch { rows, .. } = self.longest;
        let (others, equal) = (self.rows.saturating_sub(rows), self.equal.saturating_sub(rows - 1));
        let share = (equal as f64 + 1.0) / (others as f64 + 2.0);
        let chance = self.rows as f64 * share.powi(i32::try_from(rows).unwrap_or(i32::MAX) - 1);
        (rows >= FEWEST && chance < BY_CHANCE).then_some(self.longest)
    }
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
                    columns.push(Column::new(channel, digits, o.line));
                    row.push(None);
                    // A column that begins later has an empty cell where the others have a number.
                    alike.extend((0..place).filter(|_| number == 0).map(|before| [before, place]));
                }
                columns[place].read(digits, o.line);
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
            let whole = Idle { channel, copy_of, stretch: None, rows };
            if is_one_number || copy_of.is_some() {
                return Some(whole);
            }
            let stretch = |Stretch { lines: [first, last], rows, .. }| {
                let lines = LineRange::between(first, last);
                Idle { stretch: Some(lines), rows, ..whole }
            };
            column.stretch().map(stretch)
        });
    found.collect()
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn a_stretch_of_one_number_is_seen_unless_the_numbers_are_coarse() {
        let (_, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let row = data.observations[0];
        // Of the first number the last rows are one; the second is rounded so that many are.
        let fill = |stuck: u64| -> Vec<_> {
            let rows = (0..60_u64).map(|k| {
                let wave = (k as f64).sin();
                let held = if k < 60 - stuck { wave } else { 0.25 };
                let measured = [held, (wave * 0.6).round(), wave, 2.0 * wave, 3.0 * wave, 4.0 * wave];
                hexbench_core::Observation { line: k + 2, measured, ..row }
            });
            rows.collect()
        };
        for (stuck, expected) in [(11, vec![]), (12, vec![(Some(LineRange::between(50, 61)), 12)])] {
            data.observations = fill(stuck);
            let found: Vec<_> = idle(&data).iter().map(|i| (i.stretch, i.rows)).collect();
            assert_eq!(found, expected);
        }
    }

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
