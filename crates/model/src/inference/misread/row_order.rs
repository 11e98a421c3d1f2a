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
    /// The poses are those of the next pose in the file.
    PosesBelow,
    /// The poses are those of the pose before.
    PosesAbove,
}

impl RowOrder {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::LoadsBelow, Self::LoadsAbove, Self::LoadsReversed, Self::PosesBelow, Self::PosesAbove];

    /// One word, as `--read-as` takes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::LoadsBelow => "loads-from-below",
            Self::LoadsAbove => "loads-from-above",
            Self::LoadsReversed => "loads-reversed",
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

/// Every block of rows with one pose takes the pose of the block after it (`by` 1) or before it.
fn shift_poses(rows: &mut [Observation], by: usize) {
    let poses: Vec<Pose> = rows.chunk_by(|a, b| a.pose == b.pose).map(|block| block[0].pose).collect();
    let n = poses.len().max(1);
    let by = by.min(n - 1);
    for (k, block) in rows.chunk_by_mut(|a, b| a.pose == b.pose).enumerate() {
        block.iter_mut().for_each(|row| row.pose = poses[(k + by) % n]);
    }
}
