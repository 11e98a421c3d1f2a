//! Readings at the end of the range of the instrument.
//!
//! A number that would be larger is read as the largest one: the same digits come again under different loads, on one side of zero or on
//! both, while no other number comes nearly as often.

use std::collections::{HashMap, HashSet};

use hexbench_core::{Channel, Dataset, Observation, Sensor};

use super::{Finding, FindingKind, states_no_load};

/// Least different conditions under load at the end of the range: exact readings of a symmetric plan are equal in a few.
const LEAST_CONDITIONS: usize = 5;
/// The largest number comes so many times as often as any other.
const TIMES_AS_OFTEN: usize = 3;
/// A larger share of the readings at the end is no range.
const LARGEST_SHARE: usize = 3;

/// The end of the range of each column that has one in these deflections, m or rad.
pub(crate) fn ends_of_range(data: &Dataset) -> Vec<(Channel, f64)> {
    if data.is_absolute() {
        return Vec::new();
    }
    let sizes = |channel| -> Vec<(&Observation, f64)> {
        let of_row = |row: &Observation| Some(row.measured[data.place_of(row, channel)?].abs());
        data.observations.iter().filter_map(|row| Some((row, of_row(row)?))).collect()
    };
    data.all_channels().filter_map(|channel| Some((channel, end_of(&sizes(channel))?))).collect()
}

/// The largest number, where it comes in many conditions and no other does.
fn end_of(readings: &[(&Observation, f64)]) -> Option<f64> {
    let end = readings.iter().map(|(_, number)| *number).fold(0.0, f64::max);
    let at_end: Vec<&Observation> = readings
        .iter()
        .filter(|(_, number)| number.to_bits() == end.to_bits())
        .map(|(row, _)| *row)
        .collect();
    let conditions: HashSet<_> =
        at_end.iter().filter(|row| !states_no_load(row)).map(|row| loads(row)).collect();
    if conditions.len() < LEAST_CONDITIONS || at_end.len() * LARGEST_SHARE > readings.len() {
        return None;
    }
    let mut often: HashMap<u64, usize> = HashMap::new();
    for (_, number) in readings.iter().filter(|(_, number)| number.to_bits() != end.to_bits()) {
        *often.entry(number.to_bits()).or_default() += 1;
    }
    let others = often.into_values().max().unwrap_or(0);
    (at_end.len() >= TIMES_AS_OFTEN * others).then_some(end)
}

fn loads(row: &Observation) -> [[u64; 6]; 2] {
    [row.pose.bits(), row.wrench.to_array().map(f64::to_bits)]
}

/// Where a row is at the end of a range.
pub(crate) fn is_at_end(data: &Dataset, row: &Observation, ends: &[(Channel, f64)]) -> bool {
    let is_at = |(channel, end): &(Channel, f64)| {
        data.place_of(row, *channel).is_some_and(|k| row.measured[k].abs() >= *end)
    };
    ends.iter().any(is_at)
}

/// Rows that are left out for it.
pub(super) fn at_end_of_range(data: &Dataset, sensors: &[Sensor]) -> Option<Finding> {
    let ends = ends_of_range(data);
    if ends.is_empty() {
        return None;
    }
    let mut rows: Vec<u64> =
        data.observations.iter().filter(|row| is_at_end(data, row, &ends)).map(|row| row.line).collect();
    rows.dedup();
    let told = |(channel, end): &(Channel, f64)| {
        format!("{} {:.3} {}", channel.name(sensors, data.measurand), end * 1e6, channel.unit(sensors))
    };
    let size = ends.iter().map(told).collect::<Vec<_>>().join(", ");
    Some(Finding {
        text: format!(
            "under different loads the instrument shows the same largest number, and never a larger one ({size}): the end of its range, in \
             {} rows, which are left out",
            rows.len()
        ),
        rows,
        size,
        next: "set the instrument to a wider range, or read these conditions again under smaller loads"
            .to_owned(),
        ..Finding::of(FindingKind::Blunder)
    })
}
