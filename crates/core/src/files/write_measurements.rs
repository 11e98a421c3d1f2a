//! Writing a table of measurements in the units of the format.

use super::columns::{
    APPROACH, COLUMNS, Column, DELTA_T, ELAPSED, Group, MEASURED, ORDER, OVERLOAD, PLACES, POSE, POSE_ID,
    REFERENCE, REFERENCE_AGE, REFERENCE_RECORD, REPEAT, Row, SIGMA, WRENCH,
};
use super::header::measured_groups;
use super::units::{PLAIN, Unit, unit_named};
use super::{FileError, atomic_write};
use crate::{Columns, Dataset, Measurand, Observation};
use std::io::{self, Write};
use std::path::Path;

/// Writes `measurements.csv` whole or not at all, in the units of the format.
///
/// Numbers are the shortest decimals that read back as the same number; where the change of unit leaves none, they
/// read back within one rounding.
///
/// # Errors
/// A full disk, a folder that cannot be written to, or a dataset that could not be read again (a number that is not
/// finite, a row without `sigma` in a dataset that has them).
pub fn write_measurements(path: &Path, dataset: &Dataset) -> Result<(), FileError> {
    atomic_write(path, |out| measurements_to_csv(out, dataset))
        .map_err(|cause| FileError::writing(path, cause))
}

/// The same to any destination.
///
/// # Errors
/// As [`write_measurements`].
pub fn measurements_to_csv(out: &mut dyn Write, dataset: &Dataset) -> io::Result<()> {
    let writer = MeasurementsWriter::new(dataset.measurand, dataset.columns);
    writer.header(out)?;
    writer.rows(out, &dataset.observations)
}

/// The same as columns in memory: name with unit, and one number per reading.
pub fn measurements_to_columns(dataset: &Dataset) -> Vec<(String, Vec<f64>)> {
    columns_of(dataset, &MeasurementsWriter::new(dataset.measurand, dataset.columns).columns)
}

/// Poses and loads as columns in memory, without what was measured.
pub fn conditions_to_columns(dataset: &Dataset) -> Vec<(String, Vec<f64>)> {
    columns_of(dataset, &MeasurementsWriter::conditions(dataset.columns).columns)
}

fn columns_of(dataset: &Dataset, columns: &[Written]) -> Vec<(String, Vec<f64>)> {
    let rows: Vec<Row> = dataset.observations.iter().map(row_of).collect();
    let values = |w: &Written| rows.iter().map(|row| w.value(row)).collect();
    columns.iter().map(|written| (written.column.usual_name(), values(written))).collect()
}

/// Writes a table part by part, for tables that do not fit into memory.
#[derive(Debug)]
pub struct MeasurementsWriter {
    columns: Vec<Written>,
}

impl MeasurementsWriter {
    /// A table of this kind with these optional columns.
    pub fn new(measurand: Measurand, columns: Columns) -> Self {
        let written = COLUMNS.iter().filter_map(|column| Written::of(column, measurand, columns));
        Self { columns: written.collect() }
    }

    /// A table of poses and loads without measured values: what `read_conditions` reads.
    pub fn conditions(columns: Columns) -> Self {
        let mut writer = Self::new(Measurand::DeflectionEuler, Columns { sigma: false, ..columns });
        writer.columns.retain(|written| !matches!(written.column.group, Group::Deflection | Group::Euler));
        writer
    }

    /// The line with the names of the columns.
    ///
    /// # Errors
    /// What the destination reports.
    pub fn header(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.names().collect::<Vec<_>>().join(","))
    }

    /// Names of the columns.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.columns.iter().map(|written| written.column.usual_name())
    }

    /// Unit of a column as a name has it, empty for plain numbers.
    pub fn unit(&self, column: usize) -> &'static str {
        self.columns[column].unit.name
    }

    /// Number of a row in a column, in its unit; what the row numbers are (`pose`, `repeat`) included.
    pub fn value(&self, column: usize, row: &Observation) -> f64 {
        self.columns[column].value(&row_of(row))
    }

    /// Numbers of a row in all columns, each with its [unit](Self::unit).
    pub fn values(&self, row: &Observation) -> impl Iterator<Item = (f64, &'static str)> {
        let row = row_of(row);
        self.columns.iter().map(move |written| (written.value(&row), written.unit.name))
    }

    /// Some rows, which go below those written before.
    ///
    /// # Errors
    /// As [`write_measurements`].
    pub fn rows(&self, out: &mut dyn Write, rows: &[Observation]) -> io::Result<()> {
        rows.iter().try_for_each(|row| write_row(out, &self.columns, &row_of(row), row))
    }

    /// The cells of a row, without the end of the line.
    pub(crate) fn cells(&self, out: &mut dyn Write, row: &Observation) -> io::Result<()> {
        write_cells(out, &self.columns, &row_of(row), row)
    }
}

/// A column with its unit.
#[derive(Debug)]
struct Written {
    column: &'static Column,
    unit: &'static Unit,
}

impl Written {
    fn of(column: &'static Column, measurand: Measurand, has: Columns) -> Option<Self> {
        let unit = unit_named(column.usual_unit(), column.kind).unwrap_or(&PLAIN);
        is_written(column, measurand, has).then_some(Self { column, unit })
    }

    fn value(&self, row: &Row) -> f64 {
        self.unit.from_si(row[self.column.places.first])
    }
}

fn is_written(column: &Column, measurand: Measurand, has: Columns) -> bool {
    match column.group {
        Group::Number | Group::Pose | Group::Wrench => true,
        Group::Reference => has.reference,
        Group::Sigma => has.sigma && column.is_usual_name(),
        Group::Covariate => match column.places.first {
            APPROACH => has.approach,
            OVERLOAD => has.overload,
            ORDER => has.order,
            DELTA_T => has.delta_t,
            REFERENCE_AGE => has.reference_age,
            REFERENCE_RECORD => has.reference_record,
            _ => has.elapsed,
        },
        measured => measured_groups(measurand).contains(&measured),
    }
}

fn row_of(observation: &Observation) -> Row {
    let mut row = [0.0; PLACES];
    let mut six = |first: usize, values: [f64; 6]| row[first..first + 6].copy_from_slice(&values);
    six(POSE, observation.pose.to_array());
    six(WRENCH, observation.wrench.to_array());
    six(REFERENCE, observation.reference.to_array());
    six(MEASURED, observation.measured);
    // A row without sigma in a table with them becomes NaN, which is refused below.
    six(SIGMA, observation.sigma.unwrap_or([f64::NAN; 6]));
    row[APPROACH] = observation.approach.sign();
    row[OVERLOAD] = observation.overload;
    row[DELTA_T] = observation.delta_t;
    row[ELAPSED] = observation.elapsed;
    // As of sigma below.
    row[REFERENCE_AGE] = observation.reference_age.unwrap_or(f64::NAN);
    // Whole numbers below 2^53: the readers take no others.
    row[REFERENCE_RECORD] = observation.reference_record.map_or(f64::NAN, |record| record as f64);
    row[ORDER] = observation.order.map_or(f64::NAN, |order| order as f64);
    row[POSE_ID] = observation.pose_id as f64;
    row[REPEAT] = observation.repeat as f64;
    row
}

fn write_row(out: &mut dyn Write, columns: &[Written], row: &Row, source: &Observation) -> io::Result<()> {
    write_cells(out, columns, row, source)?;
    out.write_all(b"\n")
}

fn write_cells(out: &mut dyn Write, columns: &[Written], row: &Row, source: &Observation) -> io::Result<()> {
    for (position, Written { column, unit }) in columns.iter().enumerate() {
        if position > 0 {
            out.write_all(b",")?;
        }
        match column.places.first {
            POSE_ID => write!(out, "{}", source.pose_id)?,
            REPEAT => write!(out, "{}", source.repeat)?,
            place if row[place].is_finite() => write_number(out, unit.from_si(row[place]))?,
            _ => return Err(not_finite(column, source)),
        }
    }
    Ok(())
}

fn not_finite(column: &Column, observation: &Observation) -> io::Error {
    let Observation { pose_id, repeat, .. } = observation;
    let text = format!("pose {pose_id}, repeat {repeat} has no finite {}", column.name);
    io::Error::new(io::ErrorKind::InvalidInput, text)
}

/// Plain decimals in the ordinary range, an exponent beyond it; every digit that is needed and no more.
pub(crate) fn write_number(out: &mut dyn Write, value: f64) -> io::Result<()> {
    let size = value.abs();
    if size == 0.0 || (1e-5..1e15).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}
