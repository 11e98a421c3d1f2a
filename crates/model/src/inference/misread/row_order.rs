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

impl RowOrder {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::LoadsBelow,
        Self::LoadsAbove,
        Self::LoadsReversed,
        Self::LoadOfNext,
        Self::LoadOfLast,
        Self::ReadingsBelow,
        Self::ReadingsAbove,
        Self::ReadingsReversed,
        Self::PosesBelow,
        Self::PosesAbove,
    ];

    /// One word, as `--read-as` takes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::LoadsBelow => "loads-from-below",
            Self::LoadsAbove => "loads-from-above",
            Self::LoadsReversed => "loads-reversed",
            Self::LoadOfNext => "load-of-the-next",
            Self::LoadOfLast => "load-of-the-last",
            Self::ReadingsBelow => "readings-from-below",
            Self::ReadingsAbove => "readings-from-above",
            Self::ReadingsReversed => "readings-reversed",
            Self::PosesBelow => "poses-from-below",
            Self::PosesAbove => "poses-from-above",
        }
    }

    /// What it means, in a sentence.
    pub fn text(self) -> &'static str {
        match self {
            Self::LoadsBelow => "the load of each reading stands one row below it",
            Self::LoadsAbove => "the load of each reading stands one row above it",
            Self::LoadsReversed => "the loads of each pose stand in reverse order",
            Self::LoadOfNext => {
                "the load of each reading is written beside the load after it at the same pose"
            }
            Self::LoadOfLast => {
                "the load of each reading is written beside the load before it at the same pose"
            }
            Self::ReadingsBelow => "each reading stands one row below its pose and load",
            Self::ReadingsAbove => "each reading stands one row above its pose and load",
            Self::ReadingsReversed => "the readings of the file stand in reverse order",
            Self::PosesBelow => "the pose of each reading is the next one of the file",
            Self::PosesAbove => "the pose of each reading is the one before it in the file",
        }
    }

    /// Puts together what belongs together. The sequence is taken as closed: the last row goes on with the first, as it does where
    /// a column was rolled; where it was cut, one row is off.
    pub(super) fn apply(self, data: &mut Dataset) {
        let rows = &mut data.observations;
        match self {
            Self::LoadsBelow => shift_loads(rows, Neighbor::Below),
            Self::LoadsAbove => shift_loads(rows, Neighbor::Above),
            Self::LoadsReversed => {
                for block in rows.chunk_by_mut(|a, b| a.pose == b.pose) {
                    let loads: Vec<_> = block.iter().rev().map(loads).collect();
                    for (row, loads) in block.iter_mut().zip(loads) {
                        set_loads(row, loads);
                    }
                }
            }
            Self::LoadOfNext => shift_loads_at_poses(rows, Neighbor::Below),
            Self::LoadOfLast => shift_loads_at_poses(rows, Neighbor::Above),
            Self::ReadingsBelow => shift_readings(rows, Neighbor::Below),
            Self::ReadingsAbove => shift_readings(rows, Neighbor::Above),
            Self::ReadingsReversed => {
                let all: Vec<_> = rows.iter().rev().map(|row| row.measured).collect();
                rows.iter_mut().zip(all).for_each(|(row, measured)| row.measured = measured);
            }
            Self::PosesBelow => shift_poses(rows, Neighbor::Below),
            Self::PosesAbove => shift_poses(rows, Neighbor::Above),
        }
    }
}

fn loads(row: &Observation) -> (Wrench, Wrench) {
    (row.wrench, row.reference)
}

/// Where a row takes from what is its own.
#[derive(Clone, Copy)]
enum Neighbor {
    Below,
    Above,
}

impl Neighbor {
    /// Every entry is that of its neighbor; the sequence is closed.
    fn rolled<T>(self, mut all: Vec<T>) -> Vec<T> {
        if !all.is_empty() {
            match self {
                Self::Below => all.rotate_left(1),
                Self::Above => all.rotate_right(1),
            }
        }
        all
    }
}

fn set_loads(row: &mut Observation, (wrench, reference): (Wrench, Wrench)) {
    (row.wrench, row.reference) = (wrench, reference);
}

fn shift_loads(rows: &mut [Observation], from: Neighbor) {
    let all = from.rolled(rows.iter().map(loads).collect());
    for (row, loads) in rows.iter_mut().zip(all) {
        set_loads(row, loads);
    }
}

fn shift_readings(rows: &mut [Observation], from: Neighbor) {
    let all = from.rolled(rows.iter().map(|row| row.measured).collect());
    for (row, measured) in rows.iter_mut().zip(all) {
        row.measured = measured;
    }
}

/// At every pose each run of rows with one load takes the load of a neighboring run.
fn shift_loads_at_poses(rows: &mut [Observation], from: Neighbor) {
    let same = |a: &Observation, b: &Observation| loads(a) == loads(b);
    for block in rows.chunk_by_mut(|a, b| a.pose == b.pose) {
        let all = from.rolled(block.chunk_by(same).map(|run| loads(&run[0])).collect());
        for (run, loads) in block.chunk_by_mut(same).zip(all) {
            for row in run {
                set_loads(row, loads);
            }
        }
    }
}

/// Every block of rows with one pose takes the pose of a neighboring block.
fn shift_poses(rows: &mut [Observation], from: Neighbor) {
    let same = |a: &Observation, b: &Observation| a.pose == b.pose;
    let all = from.rolled(rows.chunk_by(same).map(|block| block[0].pose).collect());
    for (block, pose) in rows.chunk_by_mut(same).zip(all) {
        for row in block {
            row.pose = pose;
        }
    }
}
