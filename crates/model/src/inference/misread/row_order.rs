//! Rows that belong together in another order.

use hexbench_core::{Dataset, Observation, Wrench};

/// Columns of the file that stand in other rows than the readings they belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowOrder {
    /// The loads are those of the row below.
    LoadsBelow,
    /// The loads are those of the row above.
    LoadsAbove,
    /// The loads within each pose stand in reverse.
    LoadsReversed,
    /// The load of each reading is that of the next load at its pose.
    LoadOfNext,
    /// The load of each reading is that of the load before it at its pose.
    LoadOfLast,
    /// The readings are those of the row below.
    ReadingsBelow,
    /// The readings are those of the row above.
    ReadingsAbove,
    /// The readings of the whole file stand in reverse.
    ReadingsReversed,
    /// The poses are those of the next pose in the file.
    PosesBelow,
    /// The poses are those of the pose before.
    PosesAbove,
}

hexbench_core::worded! {
    /// One word, as `--read-as` takes it.
    RowOrder::word,
    /// What it means, in a sentence.
    text {
        LoadsBelow => "loads-from-below", "the load of each reading is one row below it";
        LoadsAbove => "loads-from-above", "the load of each reading is one row above it";
        LoadsReversed => "loads-reversed", "the loads of each pose are in reverse order";
        LoadOfNext => "load-of-the-next", "the load of each reading is in the row of the next load at the same pose";
        LoadOfLast => "load-of-the-last", "the load of each reading is in the row of the previous load at the same pose";
        ReadingsBelow => "readings-from-below", "each reading is one row below its pose and load";
        ReadingsAbove => "readings-from-above", "each reading is one row above its pose and load";
        ReadingsReversed => "readings-reversed", "the readings of the file are in reverse order";
        PosesBelow => "poses-from-below", "the pose of each reading is the next one of the file";
        PosesAbove => "poses-from-above", "the pose of each reading is the one before it in the file";
    }
}

impl RowOrder {
    /// True when only loads are moved.
    pub(super) fn is_of_loads(self) -> bool {
        matches!(
            self,
            Self::LoadsBelow | Self::LoadsAbove | Self::LoadsReversed | Self::LoadOfNext | Self::LoadOfLast
        )
    }

    /// Puts together what belongs together. The sequence is taken as closed: the last row goes on with the first, as it does where
    /// a column was rolled; where it was cut, one row is off.
    pub(super) fn apply(self, data: &mut Dataset) {
        let mut rows: Vec<Row> = data.rows().map(Row::of).collect();
        match self {
            Self::LoadsBelow => shift_loads(&mut rows, Neighbor::Below),
            Self::LoadsAbove => shift_loads(&mut rows, Neighbor::Above),
            Self::LoadsReversed => {
                for block in rows.chunk_by_mut(|a, b| a.at.pose == b.at.pose) {
                    let loads: Vec<_> = block.iter().rev().map(Row::loads).collect();
                    for (row, loads) in block.iter_mut().zip(loads) {
                        row.set_loads(loads);
                    }
                }
            }
            Self::LoadOfNext => shift_loads_at_poses(&mut rows, Neighbor::Below),
            Self::LoadOfLast => shift_loads_at_poses(&mut rows, Neighbor::Above),
            Self::ReadingsBelow => set_readings(&mut rows, |all| Neighbor::Below.rolled(all)),
            Self::ReadingsAbove => set_readings(&mut rows, |all| Neighbor::Above.rolled(all)),
            Self::ReadingsReversed => set_readings(&mut rows, <[_]>::reverse),
            Self::PosesBelow => shift_poses(&mut rows, Neighbor::Below),
            Self::PosesAbove => shift_poses(&mut rows, Neighbor::Above),
        }
        data.observations = rows.iter().flat_map(Row::observations).collect();
    }
}

/// A row of the file: its inputs, and what was read.
struct Row {
    at: Observation,
    readings: Vec<Reading>,
}

/// Up to six numbers: what they are, their values and their standard deviations.
type Reading = (usize, [f64; 6], Option<[f64; 6]>);

impl Row {
    fn of(observations: &[Observation]) -> Self {
        let readings = observations.iter().map(|o| (o.block, o.measured, o.sigma)).collect();
        Self { at: observations[0], readings }
    }

    fn observations(&self) -> impl Iterator<Item = Observation> {
        self.readings.iter().map(|&(block, measured, sigma)| Observation {
            block,
            measured,
            sigma,
            ..self.at
        })
    }

    fn loads(&self) -> (Wrench, Wrench) {
        (self.at.wrench, self.at.reference)
    }

    fn set_loads(&mut self, (wrench, reference): (Wrench, Wrench)) {
        (self.at.wrench, self.at.reference) = (wrench, reference);
    }
}

/// Where a row takes from what is its own.
#[derive(Clone, Copy)]
enum Neighbor {
    Below,
    Above,
}

impl Neighbor {
    /// Every entry is that of its neighbor; the sequence is closed.
    fn rolled<T>(self, all: &mut [T]) {
        if !all.is_empty() {
            match self {
                Self::Below => all.rotate_left(1),
                Self::Above => all.rotate_right(1),
            }
        }
    }
}

fn shift_loads(rows: &mut [Row], from: Neighbor) {
    let mut all: Vec<_> = rows.iter().map(Row::loads).collect();
    from.rolled(&mut all);
    rows.iter_mut().zip(all).for_each(|(row, loads)| row.set_loads(loads));
}

fn set_readings(rows: &mut [Row], reorder: impl FnOnce(&mut [Vec<Reading>])) {
    let mut all: Vec<_> = rows.iter_mut().map(|row| std::mem::take(&mut row.readings)).collect();
    reorder(&mut all);
    rows.iter_mut().zip(all).for_each(|(row, readings)| row.readings = readings);
}

/// At every pose each run of rows with one load takes the load of a neighboring run.
fn shift_loads_at_poses(rows: &mut [Row], from: Neighbor) {
    let same = |a: &Row, b: &Row| a.loads() == b.loads();
    for block in rows.chunk_by_mut(|a, b| a.at.pose == b.at.pose) {
        let mut all: Vec<_> = block.chunk_by(same).map(|run| run[0].loads()).collect();
        from.rolled(&mut all);
        for (run, loads) in block.chunk_by_mut(same).zip(all) {
            for row in run {
                row.set_loads(loads);
            }
        }
    }
}

/// Every block of rows with one pose takes the pose of a neighboring block.
fn shift_poses(rows: &mut [Row], from: Neighbor) {
    let same = |a: &Row, b: &Row| a.at.pose == b.at.pose;
    let mut all: Vec<_> = rows.chunk_by(same).map(|block| block[0].at.pose).collect();
    from.rolled(&mut all);
    for (block, pose) in rows.chunk_by_mut(same).zip(all) {
        for row in block {
            row.at.pose = pose;
        }
    }
}
