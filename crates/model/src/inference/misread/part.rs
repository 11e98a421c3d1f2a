//! A sign, a unit or an axis that changes in the middle of a file: another instrument, another hand, a setting.
//!
//! Every row is looked at as it is written and with every sign, unit and axis that may have changed. Springs fitted to the rows before a
//! boundary as written, to those behind it with the change, and so on, cost a sum of normal equations each; the best of a few
//! boundaries are then moved to where they fit best, row by row.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use hexbench_core::{Dataset, Hexapod, LineRange, Vector6, spread_of};

use super::change::{Change, Group, Multiple, Signed};
use super::normal::{Normal, Whitened};
use super::sample::Sample;
use super::{Readable, hypotheses, sensors};

/// Rows looked at.
const MOST_ROWS: usize = 240;
/// Boundaries tried at first.
const BOUNDARIES: usize = 12;
/// One row in so many has to be concerned: fewer are single mistakes.
const LEAST_SHARE: usize = 12;
/// Changes whose boundaries are moved.
const REFINED: usize = 4;
/// Times they are moved at most.
const MOVES: usize = 4;

/// A change of some lines.
pub(super) struct Part {
    pub(super) change: Change,
    /// What its lines and its unit cost, in twice the log-likelihood.
    pub(super) cost: f64,
}

/// The best changes of some lines of a file; `sample`: its averages.
pub(super) fn parts(sample: &Sample, data: &Dataset, readable: Readable) -> Vec<Part> {
    let rows: Vec<_> = spread_of(&data.observations, MOST_ROWS).collect();
    let rows = sample.of_rows(&rows, data);
    let Some(written) = rows.whitened_rows(&[]) else { return Vec::new() };
    let may_be =
        multiples(&sample.hexapod, data).into_iter().filter(|multiple| readable.has(&multiple.everywhere()));
    let mut tried = parallel::filter_map(&may_be.collect::<Vec<_>>(), |&multiple| {
        go_on();
        let changed = rows.whitened_rows(&[multiple.everywhere()])?;
        let (cost, range) = Both { rows: &rows, written: &written, changed: &changed }.coarse()?;
        Some((cost, multiple, range))
    });
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.truncate(REFINED);
    let found = tried.into_iter().filter_map(|(_, multiple, range)| {
        let changed = rows.whitened_rows(&[multiple.everywhere()])?;
        let range = Both { rows: &rows, written: &written, changed: &changed }.moved(range)?;
        let lines = exact(sample, data, multiple, range.map(|row| rows.data.observations[row].line))?;
        let concerned = data.observations.iter().filter(|row| lines.contains(row.line)).count();
        let count = data.observations.len();
        is_part(concerned, count).then(|| Part {
            change: Change::Within(lines, multiple),
            cost: 4.0 * (count as f64).ln() - 2.0 * sample.scale_within(lines, multiple.everywhere()),
        })
    });
    found.collect()
}

/// True for as many rows of a file as a change of a part concerns: not all, and no single mistakes.
pub(super) fn is_part(concerned: usize, count: usize) -> bool {
    concerned < count && concerned * LEAST_SHARE >= count
}

/// Signs, units and axes that may change in a file.
fn multiples(hexapod: &Hexapod, data: &Dataset) -> Vec<Multiple> {
    let all = if data.has_other_readings() {
        sensors::cheap(hexapod, data)
    } else {
        hypotheses::cheap(hexapod, data)
    };
    all.into_iter().filter_map(Multiple::of).filter(is_of_rows).collect()
}

/// True for what is written in each row by itself, and in a way of its own.
fn is_of_rows(multiple: &Multiple) -> bool {
    match multiple {
        Multiple::Reversed(signed) => *signed != Signed::Reference,
        Multiple::Scaled(group, _) => matches!(
            group,
            Group::Translations | Group::Rotations | Group::Readings | Group::Forces | Group::Moments
        ),
        Multiple::SensorReversed(_)
        | Multiple::SensorScaled(..)
        | Multiple::Renamed(..)
        | Multiple::Pose(..) => true,
    }
}

/// Rows as they are written and with a change.
struct Both<'a> {
    rows: &'a Sample,
    written: &'a [Whitened],
    changed: &'a [Whitened],
}

impl Both<'_> {
    /// The best of a few ranges of rows that have the change, the last row included, and its cost; none where no springs explain any.
    fn coarse(&self) -> Option<(f64, [usize; 2])> {
        let count = self.written.len();
        let bounds: Vec<usize> = (0..=BOUNDARIES).map(|k| k * count / BOUNDARIES).collect();
        let sums = |rows: &[Whitened]| -> Vec<Normal> {
            let mut all = vec![Normal::default()];
            for ends in bounds.windows(2) {
                let mut next = all.last().copied().unwrap_or_default();
                rows[ends[0]..ends[1]].iter().for_each(|row| next.push(row));
                all.push(next);
            }
            all
        };
        let (written, changed) = (sums(self.written), sums(self.changed));
        let mut best: Option<(f64, [usize; 2])> = None;
        for i in 0..BOUNDARIES {
            for j in i + 1..=BOUNDARIES {
                let is_whole = (i, j) == (0, BOUNDARIES);
                if is_whole || bounds[j] <= bounds[i] {
                    continue;
                }
                let outside = written[BOUNDARIES] - (written[j] - written[i]);
                let normal = outside + (changed[j] - changed[i]);
                let Some((cost, _)) = self.rows.springs_of(&normal) else { continue };
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, [bounds[i], bounds[j] - 1]));
                }
            }
        }
        best
    }

    /// Boundaries moved to where springs fit best.
    fn moved(&self, mut range: [usize; 2]) -> Option<[usize; 2]> {
        for _ in 0..MOVES {
            let mut normal = Normal::default();
            let both = self.written.iter().zip(self.changed).enumerate();
            for (k, (written, changed)) in both {
                normal.push(if (range[0]..=range[1]).contains(&k) { changed } else { written });
            }
            let (_, springs) = self.rows.springs_of(&normal)?;
            let moved = best_range(&self.gains(&springs))?;
            if moved == range {
                break;
            }
            range = moved;
        }
        Some(range)
    }

    /// What the change takes off each row, in twice the log-likelihood.
    fn gains(&self, springs: &Vector6) -> Vec<f64> {
        let square = |row: &Whitened| (row.read - row.columns * springs).norm_squared() - 2.0 * row.density;
        let both = self.written.iter().zip(self.changed);
        both.map(|(written, changed)| square(written) - square(changed)).collect()
    }
}

/// The rows one after the other that gain most together; none where no row gains anything.
pub(super) fn best_range(gains: &[f64]) -> Option<[usize; 2]> {
    let (mut best, mut sum, mut first) = (None, 0.0, 0);
    let mut most = 0.0;
    for (k, gain) in gains.iter().enumerate() {
        if sum <= 0.0 {
            (sum, first) = (0.0, k);
        }
        sum += gain;
        if sum > most {
            (most, best) = (sum, Some([first, k]));
        }
    }
    best
}

/// The lines of a range found among some rows, to the row; `near`: its ends.
pub(super) fn exact(
    sample: &Sample,
    data: &Dataset,
    multiple: Multiple,
    near: [u64; 2],
) -> Option<LineRange> {
    if data.observations.len() <= MOST_ROWS {
        return Some(LineRange::between(near[0], near[1]));
    }
    let rows = sample.of_rows(&data.observations, data);
    let (written, changed) = (rows.whitened_rows(&[])?, rows.whitened_rows(&[multiple.everywhere()])?);
    let at = |line: u64| data.observations.iter().position(|row| row.line == line);
    let range = [at(near[0])?, at(near[1])?];
    let [first, last] = Both { rows: &rows, written: &written, changed: &changed }.moved(range)?;
    Some(LineRange::between(data.observations[first].line, data.observations[last].line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_that_gain_most_together_are_one_part_of_a_file() {
        assert_eq!(best_range(&[-1.0, 2.0, -0.5, 3.0, -4.0, 1.0]), Some([1, 3]));
        assert_eq!(best_range(&[3.0, -5.0, 2.0, 2.0]), Some([2, 3]));
        assert_eq!(best_range(&[-1.0, 0.0]), None);
        assert_eq!([1, 11, 12].map(|rows| is_part(rows, 12)), [true, true, false]);
        assert!(!is_part(1, 13));
    }
}
