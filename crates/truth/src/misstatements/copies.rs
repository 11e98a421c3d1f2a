//! Rows copied to look like readings of their own.

use hexbench_core::{Dataset, Hexapod, Observation};
use rand_pcg::Pcg64;

use super::{Misstatement, MisstatementEntry};

const COPIES: &[&str] = &["copies"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Measurements "rows-copied-as-repeats" "Every row is copied as one repeat more.", COPIES => Copies::Repeats;
    Measurements "rows-copied-as-poses" "Every row is copied as one of another pose.", COPIES => Copies::Poses;
    Measurements "first-repeats-copied" "The first reading of a condition is copied over the others.", COPIES
        => Copies::First;
];

/// What copies stand for.
#[derive(Debug)]
enum Copies {
    Repeats,
    Poses,
    First,
}

impl Misstatement for Copies {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        let rows = &mut data.observations;
        match self {
            Self::Repeats => append(rows, |row| &mut row.repeat),
            Self::Poses => append(rows, |row| &mut row.pose_id),
            Self::First => {
                for of in rows.chunk_by_mut(|a, b| a.pose_id == b.pose_id && a.wrench == b.wrench) {
                    let first = of[0].measured;
                    for row in of {
                        row.measured = first;
                    }
                }
            }
        }
    }
}

/// Appends a copy of every row with another number.
fn append(rows: &mut Vec<Observation>, number: fn(&mut Observation) -> &mut i64) {
    let mut copies = rows.clone();
    let last = copies.iter_mut().map(|row| *number(row)).max().unwrap_or(0);
    for (row, line) in copies.iter_mut().zip(rows.len() as u64 + 2..) {
        *number(row) += last;
        row.line = line;
    }
    rows.append(&mut copies);
}
