//! Readings that are wrong whatever the machine does, known before any effect is weighed.
//!
//! A decimal point in the wrong place, or one pose a radian off, leads a fit astray: springs and frames bend towards it, and what is left
//! looks like physics, or like another unit of the whole file. A fit that the worst readings do not move shows them by themselves.

mod deflections;
mod poses;
mod range;
mod unloaded;

use hexbench_core::{Dataset, Hexapod};

use self::deflections::{BesideSprings, far_from_springs};
pub(crate) use self::range::{ends_of_range, is_at_end};
pub use self::unloaded::states_no_load;
pub(crate) use self::unloaded::{name_and_range, not_entered, states_nothing_of};
use super::finding::{Finding, FindingKind};
use super::{MOST_FAULTS, MOST_LEFT_OUT};

/// A reading is gross when it is this many times farther from what is expected than half of the readings are.
const TIMES_MEDIAN: f64 = 20.0;

/// Readings far from what the others let expect, a finding for each; none where so many are that the file as a whole means something else.
pub fn gross_readings(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    if let Some(found) = not_entered(data).filter(Finding::excludes) {
        return vec![found];
    }
    let (found, unloaded) = if data.is_absolute() {
        (poses::far_from_command(hexapod, data), None)
    } else {
        let springs = BesideSprings::of(hexapod, data).ok().flatten();
        springs.map_or_else(Default::default, |springs| {
            (far_from_springs(data, &springs), unloaded::moving(hexapod, data, &springs))
        })
    };
    let most = MOST_FAULTS.min(data.observations.len() / MOST_LEFT_OUT);
    let few = if found.len() > most { Vec::new() } else { found };
    let at_end = range::at_end_of_range(data, &hexapod.sensors);
    few.into_iter().chain(unloaded).chain(at_end).collect()
}

/// The finding about one line.
fn blunder(line: u64, size: String, text: String, next: &str) -> Finding {
    Finding { rows: vec![line], size, text, next: next.to_owned(), ..Finding::of(FindingKind::Blunder) }
}

/// Bundled cases of deflections.
#[cfg(test)]
mod test_cases {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use std::path::Path;

    use hexbench_core::files::{read_hexapod, read_measurements};
    use hexbench_core::{Dataset, Hexapod};

    pub(super) const CASES: [&str; 5] =
        ["contact", "friction", "mujoco-clean", "not-in-catalogue", "two-effects"];

    pub(super) fn read(case: &str) -> (Hexapod, Dataset) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases").join(case);
        let hexapod = read_hexapod(&folder.join("hexapod.toml")).unwrap();
        (hexapod, read_measurements(&folder.join("measurements.csv")).unwrap().dataset)
    }
}
