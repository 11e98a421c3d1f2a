//! The practice cases as every test of this folder reads them.

use std::path::PathBuf;

use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{Dataset, Hexapod};

/// A file of a practice case.
pub(crate) fn path(case: &str, file: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "../../data/cases", case, file].iter().collect()
}

/// Hexapod, measurements and holdout of a practice case.
pub(crate) fn case(name: &str) -> (Hexapod, Dataset, Dataset) {
    let table = |file| read_measurements(&path(name, file)).unwrap().dataset;
    (read_hexapod(&path(name, "hexapod.toml")).unwrap(), table("measurements.csv"), table("holdout.csv"))
}
