//! Readings that are wrong whatever the machine does, known before any effect is weighed.
//!
//! A decimal point in the wrong place, or one pose a radian off, leads a fit astray: springs and frames bend towards it, and what is left
//! looks like physics, or like another unit of the whole file. A fit that the worst readings do not move shows them by themselves.

mod deflections;
mod poses;

use hexbench_core::{Dataset, Hexapod};

use super::finding::{Finding, FindingKind};
use super::{MOST_FAULTS, MOST_LEFT_OUT};

/// A reading is gross when it is this many times farther from what is expected than half of the readings are.
const TIMES_MEDIAN: f64 = 20.0;

/// Readings far from what the others let expect, a finding for each; none where so many are that the file as a whole means something else.
pub fn gross_readings(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    let found = if data.is_absolute() {
        poses::far_from_command(hexapod, data)
    } else {
        deflections::far_from_springs(hexapod, data).unwrap_or_default()
    };
    let most = MOST_FAULTS.min(data.observations.len() / MOST_LEFT_OUT);
    if found.len() > most { Vec::new() } else { found }
}

/// The finding about one line.
fn blunder(line: u64, size: String, text: String, next: &str) -> Finding {
    let next = next.to_owned();
    let (kind, rows) = (FindingKind::Blunder, vec![line]);
    Finding { kind, probability: 1.0, rows, size, text, next, read_as: Vec::new() }
}
