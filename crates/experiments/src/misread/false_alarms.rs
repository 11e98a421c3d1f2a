//! Sound campaigns whose files are blamed.

use hexbench_core::statistics::Proportion;

use super::MisreadRecord;

/// Ranges of sizes over the usual one, with their names: what is drawn is one of 1, 3 and 10.
pub(super) const RANGES: [(&str, [f64; 2]); 3] =
    [("usual size", [0.0, 2.0]), ("3 times", [2.0, 6.0]), ("10 times", [6.0, f64::INFINITY])];

/// A hidden effect that is itself a load left out of the file, and the finding that says so.
const LEFT_OUT: (&str, &str) = ("out:load-mass-error", "reference-missing");

/// True for a sound campaign whose file is blamed.
pub(crate) fn is_blamed(record: &MisreadRecord) -> bool {
    let lacks_a_load = record.campaign.hidden.split('+').any(|id| id == LEFT_OUT.0);
    let is_false = |kind: &str| !(lacks_a_load && kind == LEFT_OUT.1);
    record.misstatement.is_none() && record.about_file().any(is_false)
}

/// Sound campaigns that are blamed, of those that pass.
pub(super) fn blamed(records: &[MisreadRecord], among: impl Fn(&MisreadRecord) -> bool) -> Proportion {
    let sound = records.iter().filter(|r| r.misstatement.is_none() && among(r));
    Proportion::count(sound, |r| is_blamed(r))
}

/// The same of a kind and a range of sizes; of all sizes without one.
pub(super) fn of_kind(records: &[MisreadRecord], kind: &str, range: Option<[f64; 2]>) -> Proportion {
    blamed(records, |r| r.campaign.kind == kind && range.is_none_or(|range| is_of_size(r, range)))
}

/// True for effects of a size in a range.
pub(super) fn is_of_size(record: &MisreadRecord, [low, high]: [f64; 2]) -> bool {
    record.campaign.size.is_some_and(|size| (low..high).contains(&size))
}
