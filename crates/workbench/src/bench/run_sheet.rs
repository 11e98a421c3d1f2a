//! The proposed readings as a run sheet: a table to fill in at the machine and open again, and a page to print.

use std::io;

use hexbench_core::files::{Dimension, MeasurementsWriter, unit_named};
use hexbench_core::{Columns, Dataset, Hexapod, Observation, Pose, Wrench};
use hexbench_model::results::diagnose::NextReport;

use super::digits::{all_short, short};
use super::refusal::{Refusal, RefusalKind};

/// The pose of a reading. In the arithmetic of the units of files, so that a table has the digits that are set.
pub(super) fn pose(reading: &NextReport) -> Pose {
    let units = [("mm", Dimension::Length), ("deg", Dimension::Angle)].map(|(name, of)| unit_named(name, of));
    let si = |k: usize| {
        let value = short(reading.pose[k]);
        units[k / 3].map_or(value, |unit| unit.to_si(value))
    };
    Pose::from_array(std::array::from_fn(si))
}

/// What is to be set for every reading asked for beside these measurements, numbered on from them; nothing is read yet.
///
/// # Errors
/// [`RefusalKind::Conflict`] where none is asked for, or where sensors read what is no full pose.
pub(super) fn rows(data: &Dataset, next: &[NextReport]) -> Result<Dataset, Refusal> {
    let conflict = |rule: &str, step: &str| Err(Refusal::new(RefusalKind::Conflict, rule, step));
    if next.is_empty() {
        let rule = "the diagnosis of these data proposes no further readings";
        return conflict(
            rule,
            "`hexbench design` and `hexbench discriminate` plan readings for other purposes.",
        );
    }
    if data.has_other_readings() {
        let rule = "a run sheet needs full poses, but these readings come from sensors";
        return conflict(rule, "`hexbench discriminate` writes a plan of such readings.");
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
    let wrench = |six: &[f64; 6]| Wrench::from_array(all_short(*six));
    Observation {
        approach: reading.approach,
        delta_t: reading.delta_t_k,
        elapsed: reading.elapsed_s,
        ..Observation::unread(pose(reading), wrench(&reading.wrench), wrench(&reading.reference))
    }
}

/// As measurements.csv, its rows numbered, with empty cells for what is to be read: also for a temperature that is not to be set.
pub(super) fn csv(hexapod: &Hexapod, rows: &Dataset) -> Result<String, Refusal> {
    let stated = hexapod.angles.as_stated(rows);
    let delta_t = rows.observations.iter().any(|o| o.delta_t != 0.0);
    let known = Columns { reference: true, approach: true, delta_t, elapsed: true, ..Columns::default() };
    let set = MeasurementsWriter::conditions(known);
    let set_names: Vec<String> = set.names().collect();
    let all = MeasurementsWriter::new(rows.measurand, rows.columns);
    let read_names: Vec<String> = all.names().filter(|name| !set_names.contains(name)).collect();
    let mut cells = Vec::new();
    set.rows(&mut cells, &stated.observations)
        .map_err(|cause: io::Error| Refusal::bad_input(cause.to_string(), "Correct the measurements."))?;
    let blank = ",".repeat(read_names.len());
    let cells = String::from_utf8_lossy(&cells);
    let header = [set_names, read_names].concat().join(",");
    let numbered = cells.lines().enumerate().map(|(k, line)| format!("{},{}{blank}\n", k + 1, line.trim()));
    Ok(std::iter::once(format!("note_row,{header}\n")).chain(numbered).collect())
}
