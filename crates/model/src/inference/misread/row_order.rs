//! Rows that belong together in another order.

use hexbench_core::{Dataset, Observation, Pose, Wrench};

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
            Self::LoadsBelow => shift_loads(rows, 1),
            Self::LoadsAbove => shift_loads(rows, usize::MAX),
            Self::LoadsReversed => {
                for block in rows.chunk_by_mut(|a, b| a.pose == b.pose) {
                    let loads: Vec<_> = block.iter().rev().map(loads).collect();
                    for (row, (wrench, reference)) in block.iter_mut().zip(loads) {
                        (row.wrench, row.reference) = (wrench, reference);
                    }
                }
            }
            Self::LoadOfNext => shift_loads_at_poses(rows, 1),
            Self::LoadOfLast => shift_loads_at_poses(rows, usize::MAX),
            Self::ReadingsBelow => shift_readings(rows, 1),
            Self::ReadingsAbove => shift_readings(rows, usize::MAX),
            Self::ReadingsReversed => {
                let all: Vec<_> = rows.iter().rev().map(|row| row.measured).collect();
                rows.iter_mut().zip(all).for_each(|(row, measured)| row.measured = measured);
            }
            Self::PosesBelow => shift_poses(rows, 1),
            Self::PosesAbove => shift_poses(rows, usize::MAX),
        }
    }
}

fn loads(row: &Observation) -> (Wrench, Wrench) {
    (row.wrench, row.reference)
}

fn shift_loads(rows: &mut [Observation], by: usize) {
    let all: Vec<_> = rows.iter().map(loads).collect();
    let n = rows.len().max(1);
    let by = by.min(n - 1);
    for (i, row) in rows.iter_mut().enumerate() {
        (row.wrench, row.reference) = all[(i + by) % n];
    }
}

fn shift_readings(rows: &mut [Observation], by: usize) {
    let all: Vec<_> = rows.iter().map(|row| row.measured).collect();
    let n = rows.len().max(1);
    let by = by.min(n - 1);
    for (i, row) in rows.iter_mut().enumerate() {
        row.measured = all[(i + by) % n];
    }
}

/// At every pose each run of rows with one load takes the load of the run after it (`by` 1) or before it.
fn shift_loads_at_poses(rows: &mut [Observation], by: usize) {
    for block in rows.chunk_by_mut(|a, b| a.pose == b.pose) {
        let same = |a: &Observation, b: &Observation| loads(a) == loads(b);
        let all: Vec<_> = block.chunk_by(same).map(|run| loads(&run[0])).collect();
        let by = by.min(all.len() - 1);
        for (k, run) in block.chunk_by_mut(same).enumerate() {
            for row in run {
                (row.wrench, row.reference) = all[(k + by) % all.len()];
            }
        }
    }
}

/// Every block of rows with one pose takes the pose of the block after it (`by` 1) or before it.
fn shift_poses(rows: &mut [Observation], by: usize) {
    let poses: Vec<Pose> = rows.chunk_by(|a, b| a.pose == b.pose).map(|block| block[0].pose).collect();
    let n = poses.len().max(1);
    let by = by.min(n - 1);
    for (k, block) in rows.chunk_by_mut(|a, b| a.pose == b.pose).enumerate() {
        for row in block {
            row.pose = poses[(k + by) % n];
        }
    }
}
