//! The date of an update.

use std::time::{SystemTime, UNIX_EPOCH};

use hexbench_core::calendar::civil;

/// Seconds of a day.
const DAY_S: u64 = 86_400;

/// Today's date as `2026-11-21`, UTC.
pub fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let [year, month, day] = civil((since / DAY_S).cast_signed());
    format!("{year:04}-{month:02}-{day:02}")
}
