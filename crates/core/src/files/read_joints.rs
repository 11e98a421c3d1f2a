//! Reading the joints of a machine from a table.

use std::path::Path;

use super::error::Fault;
use super::points::PointTable;
use super::{FileError, FilePlace};
use crate::{BallRecord, Vector3};

/// Sides of a machine as its table calls them.
const SIDES: [&str; 2] = ["base", "platform"];

/// Reads a table of joints, columns `side` (base or platform), `leg` (1 to 6), `x_mm`, `y_mm`, `z_mm`, others are passed over: base
/// joints, then platform joints, m.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step; a joint that is missing or given twice.
pub fn read_joints(path: &Path) -> Result<[[Vector3; 6]; 2], FileError> {
    let rows = PointTable::of_joints().read(path)?.records;
    joints(&rows).map_err(|(rule, next)| Fault::rule(FilePlace::file(), rule, next).in_file(path))
}

fn joints(rows: &[BallRecord]) -> Result<[[Vector3; 6]; 2], (String, &'static str)> {
    if let Some(other) = rows.iter().find(|row| !SIDES.contains(&row.id.as_str())) {
        return Err((format!("{:?} is no side of a hexapod", other.id), "Write base or platform."));
    }
    let mut all = [[Vector3::zeros(); 6]; 2];
    for (side, joints) in SIDES.iter().zip(&mut all) {
        for (leg, joint) in (1..).zip(joints) {
            let row = rows.iter().find(|row| row.id == *side);
            let place = row.and_then(|row| row.centre(&leg.to_string()));
            *joint = place.ok_or_else(|| {
                (
                    format!("the {side} joint of leg {leg} is missing"),
                    "Give each side a row for every leg from 1 to 6.",
                )
            })?;
        }
    }
    Ok(all)
}
