//! The proposed readings as a run sheet: a table to fill in at the machine and read again.

use std::io;

use hexbench_core::files::{Dimension, MeasurementsWriter, unit_named};
use hexbench_core::{Columns, Dataset, Hexapod, Observation, Pose, Wrench};
use hexbench_model::results::diagnose::NextReport;

/// Digits behind the point of what is set, in mm, deg, N and N m.
const DECIMALS: i32 = 4;

/// Why there is no run sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NothingToFillIn {
    /// Nothing is to be read.
    #[error("the diagnosis of these data proposes no further readings")]
    NothingProposed,
    /// Sensors read what is no full pose.
    #[error("a run sheet needs full poses, but these readings come from sensors")]
    OfSensors,
}

impl NothingToFillIn {
    /// What to do instead.
    pub fn next_step(self) -> &'static str {
        match self {
            Self::NothingProposed => {
                "`hexbench design` and `hexbench discriminate` plan readings for other purposes."
            }
            Self::OfSensors => "`hexbench discriminate` writes a plan of such readings.",
        }
    }
}

/// The pose of a reading. In the arithmetic of the units of files, so that a table has the digits that are set.
pub fn pose(reading: &NextReport) -> Pose {
    let units = [("mm", Dimension::Length), ("deg", Dimension::Angle)].map(|(name, of)| unit_named(name, of));
    let si = |k: usize| {
        let value = set(reading.pose[k]);
        units[k / 3].map_or(value, |unit| unit.to_si(value))
    };
    Pose::from_array(std::array::from_fn(si))
}

/// A number as it is set at a machine.
fn set(value: f64) -> f64 {
    let steps = 10f64.powi(DECIMALS);
    (value * steps).round() / steps + 0.0
}

/// What is to be set for every reading asked for beside these measurements, numbered on from them; nothing is read yet.
///
/// # Errors
/// [`NothingToFillIn`].
pub fn rows(data: &Dataset, next: &[NextReport]) -> Result<Dataset, NothingToFillIn> {
    if next.is_empty() {
        return Err(NothingToFillIn::NothingProposed);
    }
    if data.has_other_readings() {
        return Err(NothingToFillIn::OfSensors);
    }
    let last = data.observations.iter().map(|o| o.pose_id).max().unwrap_or(0);
    let numbered = next.iter().zip(last + 1..);
    let observations = numbered.flat_map(|(reading, pose_id)| {
        (1..).take(reading.repeats).map(move |repeat| Observation { pose_id, repeat, ..unread(reading) })
    });
    let delta_t = data.columns.delta_t || next.iter().any(|reading| reading.delta_t_k != 0.0);
    let columns = Columns { reference: true, approach: true, delta_t, elapsed: true, ..data.columns };
    Ok(Dataset { observations: observations.collect(), columns, ..data.clone() })
}

fn unread(reading: &NextReport) -> Observation {
    let wrench = |six: &[f64; 6]| Wrench::from_array(six.map(set));
    Observation {
        approach: reading.approach,
        delta_t: reading.delta_t_k,
        elapsed: reading.elapsed_s,
        ..Observation::unread(pose(reading), wrench(&reading.wrench), wrench(&reading.reference))
    }
}

/// As measurements.csv, its rows numbered, with empty cells for what is to be read: also for a temperature that is not to be set.
///
/// # Errors
/// As [`MeasurementsWriter::rows`].
pub fn csv(hexapod: &Hexapod, rows: &Dataset) -> io::Result<String> {
    let stated = hexapod.angles.as_stated(rows);
    let delta_t = rows.observations.iter().any(|o| o.delta_t != 0.0);
    let known = Columns { reference: true, approach: true, delta_t, elapsed: true, ..Columns::default() };
    let set = MeasurementsWriter::conditions(known);
    let set_names: Vec<String> = set.names().collect();
    let all = MeasurementsWriter::new(rows.measurand, rows.columns);
    let read_names: Vec<String> = all.names().filter(|name| !set_names.contains(name)).collect();
    let mut cells = Vec::new();
    set.rows(&mut cells, &stated.observations)?;
    let blank = ",".repeat(read_names.len());
    let cells = String::from_utf8_lossy(&cells);
    let header = [set_names, read_names].concat().join(",");
    let numbered = cells.lines().enumerate().map(|(k, line)| format!("{},{}{blank}\n", k + 1, line.trim()));
    Ok(std::iter::once(format!("note_row,{header}\n")).chain(numbered).collect())
}
