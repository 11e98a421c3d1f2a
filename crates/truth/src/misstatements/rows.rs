//! Columns of a table that have come apart: loads, poses or readings stand in other rows.

use hexbench_core::{Dataset, Hexapod, Observation, Pose};
use rand_pcg::Pcg64;

use super::{Misstatement, MisstatementEntry};

const ORDER: &[&str] = &["row-order"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "loads-shifted-row" "Loads are shifted by one row.", ORDER => Apart::LoadsByRow;
    Tables "loads-shifted-load" "Loads are shifted by one load within each pose.", ORDER
        => Apart::LoadsByLoad;
    Tables "loads-reversed" "Loads are in reversed order within each pose.", ORDER => Apart::LoadsReversed;
    Tables "poses-shifted" "Poses are shifted by one pose.", ORDER => Apart::PosesShifted;
    Tables "readings-shifted-row" "Readings are shifted by one row.", ORDER => Apart::ReadingsByRow;
    Tables "readings-reversed" "Readings begin at the end of the table.", ORDER => Apart::ReadingsReversed;
];

/// What has come apart.
#[derive(Debug)]
pub(super) enum Apart {
    LoadsByRow,
    LoadsByLoad,
    LoadsReversed,
    PosesShifted,
    ReadingsByRow,
    ReadingsReversed,
}

impl Misstatement for Apart {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        let rows = &mut data.observations;
        match self {
            Self::LoadsByRow => {
                let moved = |loads: &mut [_]| loads.rotate_right(1);
                reorder(rows, |row| &mut row.wrench, moved);
            }
            Self::LoadsByLoad => of_each_pose(rows, |rows| {
                let repeats = rows.iter().take_while(|row| row.wrench == rows[0].wrench).count();
                reorder(rows, |row| &mut row.wrench, |loads| loads.rotate_right(repeats));
            }),
            Self::LoadsReversed => of_each_pose(rows, |rows| {
                reorder(rows, |row| &mut row.wrench, <[_]>::reverse);
            }),
            Self::PosesShifted => shift_poses(rows),
            Self::ReadingsByRow => {
                let moved = |readings: &mut [_]| readings.rotate_right(1);
                reorder(rows, |row| &mut row.measured, moved);
            }
            Self::ReadingsReversed => reorder(rows, |row| &mut row.measured, <[_]>::reverse),
        }
    }
}

/// Writes the values of a column in another order.
fn reorder<T: Copy>(
    rows: &mut [Observation],
    cell: fn(&mut Observation) -> &mut T,
    order: impl Fn(&mut [T]),
) {
    let mut values: Vec<T> = rows.iter_mut().map(|row| *cell(row)).collect();
    order(&mut values);
    rows.iter_mut().zip(values).for_each(|(row, value)| *cell(row) = value);
}

fn of_each_pose(rows: &mut [Observation], change: impl Fn(&mut [Observation])) {
    rows.chunk_by_mut(|a, b| a.pose_id == b.pose_id).for_each(change);
}

fn shift_poses(rows: &mut [Observation]) {
    let mut poses: Vec<Pose> = rows.chunk_by(|a, b| a.pose_id == b.pose_id).map(|of| of[0].pose).collect();
    poses.rotate_right(1);
    for (of, pose) in rows.chunk_by_mut(|a, b| a.pose_id == b.pose_id).zip(poses) {
        for row in of {
            row.pose = pose;
        }
    }
}
