//! Some of the readings of a long table, drawn at random.
//!
//! A search among effects takes seconds and hundreds of megabytes for tens of thousands of readings, minutes and gigabytes for millions,
//! and what it cannot decide by the former is not decided by their number. Poses are drawn, each with all of its readings: repeats and
//! neighbors stay together, and no regular plan falls in step with the choice.

use std::collections::HashMap;

use crate::streams::{Purpose, derived_seed};
use crate::{Dataset, LineRange, Observation};

/// Rows at one pose that are drawn together at most.
const TOGETHER: usize = 100;
/// The same table gives the same readings.
const SEED: u64 = 1;

impl Dataset {
    /// At most about so many readings, of a longer table drawn at random; those in lines of `kept` are among them.
    #[must_use]
    pub fn drawn(self, most: usize, kept: &[LineRange]) -> Self {
        let all = self.observations.len();
        if all <= most {
            return self;
        }
        let batches = self.batches();
        let is_drawn = drawn_batches(self.rows().zip(&batches).map(|(row, batch)| (*batch, row.len())), most);
        let is_kept = |row: &&[Observation], batch: usize| {
            is_drawn[batch] || kept.iter().any(|range| range.contains(row[0].line))
        };
        let rows = self.rows().zip(batches).filter(|(row, batch)| is_kept(row, *batch));
        let observations = rows.flat_map(|(row, _)| row).copied().collect();
        Self { observations, drawn_from: Some(all), ..self }
    }

    /// What each row is drawn with: the rows at its pose, some at a time.
    fn batches(&self) -> Vec<usize> {
        let mut last = HashMap::new();
        let mut count = 0;
        let batch_of = |row: &[Observation]| {
            let (batch, rows) = last.entry(row[0].pose.bits()).or_insert((0, TOGETHER));
            if *rows == TOGETHER {
                (*batch, *rows) = (count, 0);
                count += 1;
            }
            *rows += 1;
            *batch
        };
        self.rows().map(batch_of).collect()
    }
}

/// Which batches are drawn, for readings of so many numbers.
fn drawn_batches(rows: impl Iterator<Item = (usize, usize)>, most: usize) -> Vec<bool> {
    let mut sizes = Vec::new();
    for (batch, readings) in rows {
        sizes.resize(sizes.len().max(batch + 1), 0);
        sizes[batch] += readings;
    }
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|&batch| derived_seed(SEED, Purpose::DrawnReadings, [batch as u64]));
    let mut is_drawn = vec![false; sizes.len()];
    let mut readings = 0;
    for batch in order {
        readings += sizes[batch];
        if readings > most && readings > sizes[batch] {
            break;
        }
        is_drawn[batch] = true;
    }
    is_drawn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pose, Wrench};

    /// So many poses, each read twice, in two passes.
    fn table(poses: usize) -> Dataset {
        let row = |line: usize| {
            let pose = Pose::from_array([1e-3 * (line % poses) as f64, 0.0, 0.0, 0.0, 0.0, 0.0]);
            Observation {
                line: line as u64 + 2,
                ..Observation::unread(pose, Wrench::default(), Wrench::default())
            }
        };
        Dataset::of_deflections("long", (0..2 * poses).map(row).collect())
    }

    fn lines(data: &Dataset) -> Vec<u64> {
        data.observations.iter().map(|o| o.line).collect()
    }

    #[test]
    fn poses_are_drawn_with_all_of_their_readings() {
        let drawn = table(1000).drawn(400, &[]);
        assert_eq!((drawn.observations.len(), drawn.drawn_from), (400, Some(2000)));
        let lines = lines(&drawn);
        let (first, second) = lines.split_at(200);
        assert!(
            second.iter().map(|line| line - 1000).eq(first.iter().copied()),
            "both passes of each pose, in order"
        );
        // No regular choice: two neighbors of the file among a fifth of them.
        assert!(first.windows(2).any(|pair| pair[1] == pair[0] + 1), "{first:?}");
        assert_eq!(table(1000).drawn(400, &[]), drawn);
    }

    #[test]
    fn a_table_that_is_short_enough_is_left_alone_and_lines_asked_for_are_kept() {
        assert_eq!(table(200).drawn(400, &[]), table(200));
        let drawn = lines(&table(1000).drawn(400, &[]));
        let left_out = (2..2002).find(|line| !drawn.contains(line)).unwrap_or_default();
        let kept = lines(&table(1000).drawn(400, &[LineRange::between(left_out, left_out)]));
        assert!(kept.contains(&left_out) && kept.len() == 401);
    }

    #[test]
    fn many_readings_of_one_pose_are_drawn_some_at_a_time() {
        let drawn = table(1).drawn(1, &[]);
        assert_eq!(drawn.observations.len(), 2, "never nothing");
        let pose = table(1).observations[0];
        let long = (2..5002).map(|line| Observation { line, ..pose }).collect();
        let drawn = Dataset::of_deflections("long", long).drawn(1000, &[]);
        assert_eq!(drawn.observations.len(), 1000);
    }
}
