//! Reading a table of measurements in one pass.

use super::column_names::ColumnNames;
use super::dialect::{Dialect, LineKind};
use super::error::Fault;
use super::header::{GroupPurpose, Reads};
use super::line::{Line, whole_place};
use super::lines::{Lines, RawLine};
use super::load_columns::load_row;
use super::records::Records;
use super::row::FilledRow;
use super::source::{of_records, read_source};
use super::table::{Table, TableReading};
use super::warning::Notice;
use super::{FileError, FileProblem, Warning};
use crate::{Hexapod, LoadRow};
use std::io::BufRead;
use std::ops::Range;
use std::path::Path;

/// Reads `measurements.csv`, deflections or absolute poses; `docs/reference/file-formats.md` defines the columns.
///
/// Units are taken from the column names. Values are SI afterwards. Rows that are copies of earlier rows are dropped
/// with a warning.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step.
///
/// # Example
/// ```no_run
/// let reading = hexbench_core::files::read_measurements("measurements.csv".as_ref())?;
/// println!("{} rows", reading.dataset.observations.len());
/// # Ok::<(), hexbench_core::files::FileError>(())
/// ```
pub fn read_measurements(path: &Path) -> Result<TableReading, FileError> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    read_named(path, &name, Reads::of(GroupPurpose::Measurements, None)).map_err(|fault| fault.in_file(path))
}

/// The same of a machine whose sensors fill columns of their own; any of the six pose columns may be absent, and a cell of a
/// reading that was not taken is empty.
///
/// # Errors
/// As [`read_measurements`]; a column without its sensor, a sensor without its column, a row without any reading.
pub fn read_campaign(hexapod: &Hexapod, path: &Path) -> Result<TableReading, FileError> {
    read_campaign_named(hexapod, path, &ColumnNames::default())
}

/// The same of a table whose columns have other names.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_named(
    hexapod: &Hexapod,
    path: &Path,
    names: &ColumnNames,
) -> Result<TableReading, FileError> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let reads = Reads { names: Some(names), ..Reads::of(GroupPurpose::Measurements, Some(hexapod)) };
    read_named(path, &name, reads).map_err(|fault| fault.in_file(path))
}

/// The same of records; `path` stands for the file in messages, and the line of a row is its number from 1.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_records(
    hexapod: &Hexapod,
    records: &Records,
    names: &ColumnNames,
    path: &Path,
) -> Result<TableReading, FileError> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let reads = Reads { names: Some(names), ..Reads::of(GroupPurpose::Measurements, Some(hexapod)) };
    of_records(records, |input| read_table(input, &name, reads)).map_err(|fault| fault.in_file(path))
}

/// The same from memory or a stream; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_from(
    hexapod: &Hexapod,
    input: impl BufRead,
    name: &str,
) -> Result<TableReading, FileError> {
    read_table(input, name, Reads::of(GroupPurpose::Measurements, Some(hexapod)))
        .map_err(|fault| fault.in_file(Path::new(name)))
}

pub(crate) fn read_named(path: &Path, name: &str, reads: Reads<'_>) -> Result<TableReading, Fault> {
    read_source(path, reads.purpose.usual_sheet(), |input| read_table(input, name, reads))
}

/// The same from memory or a stream; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_measurements`].
pub fn read_measurements_from(input: impl BufRead, name: &str) -> Result<TableReading, FileError> {
    read_table(input, name, Reads::of(GroupPurpose::Measurements, None))
        .map_err(|fault| fault.in_file(Path::new(name)))
}

fn read_table(input: impl BufRead, name: &str, reads: Reads<'_>) -> Result<TableReading, Fault> {
    rows_of(input, reads)?.finish(name)
}

/// All rows of a table, before it is finished.
pub(crate) fn rows_of(input: impl BufRead, reads: Reads<'_>) -> Result<Csv, Fault> {
    let mut lines = Lines::new(input);
    let mut table = Dialect::start(&mut lines, |header, dialect| Csv::new(header, dialect, reads))?;
    let mut cells = Vec::new();
    let mut left = reads.names.map_or_else(|| ColumnNames::default().most_rows(), ColumnNames::most_rows);
    let limit = left;
    while let Some(raw) = lines.next_line()? {
        match table.dialect.kind(&raw) {
            LineKind::Row => {}
            LineKind::Names => {
                table.units = UnitRow::MayFollow;
                continue;
            }
            LineKind::Nothing => continue,
        }
        if left == 0 {
            return Err(Fault::new(whole_place(&raw), FileProblem::TooManyRows { limit }));
        }
        left -= 1;
        table.add(raw, &mut cells)?;
    }
    table.encoding = lines.encoding;
    Ok(table)
}

/// A table while it is read from text.
pub(crate) struct Csv {
    pub(crate) table: Table,
    /// Of a table of loads: records and masses of each row.
    pub(crate) loads: Vec<LoadRow>,
    dialect: Dialect,
    encoding: Option<&'static str>,
    units: UnitRow,
}

/// A row of units between the names of the columns and the first reading.
#[derive(Clone, Copy, PartialEq, Eq)]
enum UnitRow {
    MayFollow,
    Passed,
}

impl Csv {
    fn new(header: &Line<'_>, dialect: Dialect, reads: Reads<'_>) -> Result<Self, Fault> {
        Ok(Self {
            table: Table::new(header, reads)?,
            loads: Vec::new(),
            dialect,
            encoding: None,
            units: UnitRow::MayFollow,
        })
    }

    fn add(&mut self, raw: RawLine<'_>, cells: &mut Vec<Range<usize>>) -> Result<(), Fault> {
        let line =
            Line::cut(raw, self.dialect.separator, cells).map_err(|fault| self.cut_off(&raw, fault))?;
        let line = line.without_empty_beyond(self.table.plan.sources.len());
        if self.units == UnitRow::MayFollow {
            self.units = UnitRow::Passed;
            if self.table.plan.is_row_of_units(&line)? {
                return Ok(());
            }
        }
        self.add_row(&line, &raw).map_err(|fault| Dialect::explained(&line, fault))
    }

    fn add_row(&mut self, line: &Line<'_>, raw: &RawLine<'_>) -> Result<(), Fault> {
        self.refuse_other_length(line, raw.ended)?;
        let row = self.row(line)?;
        self.table
            .push(&row, line.number(), raw.text)
            .map_err(|problem| Fault::new(line.whole_place(), problem))?;
        if self.table.plan.of_loads.iter().any(Option::is_some) {
            self.add_load(line)?;
        }
        if !raw.ended {
            self.table.warnings.push(Warning::new(whole_place(raw), Notice::NoFinalNewline));
        }
        Ok(())
    }

    /// What only a table of loads says.
    fn add_load(&mut self, line: &Line<'_>) -> Result<(), Fault> {
        let plan = &self.table.plan;
        let number = |text: &str| self.dialect.number(text, line.number());
        let row = load_row(&plan.of_loads, line, number).map_err(|(cell, problem)| {
            let place = line.place(cell).with_name(&plan.names[cell]).with_value(line.text(cell));
            Fault::new(place, problem)
        })?;
        self.loads.push(row);
        Ok(())
    }

    /// An open quotation mark in a last line without newline is a file that was cut.
    fn cut_off(&self, raw: &RawLine<'_>, fault: Fault) -> Fault {
        if raw.ended {
            return fault;
        }
        let found = 1 + memchr::memchr_iter(self.dialect.separator, raw.text.as_bytes()).count();
        let expected = self.table.plan.sources.len();
        Fault::new(whole_place(raw), FileProblem::Truncated { found, expected })
    }

    fn refuse_other_length(&self, line: &Line<'_>, ended: bool) -> Result<(), Fault> {
        let (found, expected) = (line.len(), self.table.plan.sources.len());
        let problem = match found {
            _ if found == expected => return Ok(()),
            _ if !ended && found < expected => FileProblem::Truncated { found, expected },
            _ => FileProblem::CellCount { found, expected },
        };
        Err(Fault::new(line.whole_place(), problem))
    }

    fn row(&mut self, line: &Line<'_>) -> Result<FilledRow, Fault> {
        let plan = &self.table.plan;
        let mut row = FilledRow::new();
        for cell in 0..plan.sources.len() {
            let text = line.text(cell);
            if text.is_empty() && plan.may_be_empty(cell) {
                row.leave_out(plan, cell);
                continue;
            }
            let mut number = || self.dialect.number(text, line.number());
            let filled = match (&plan.sources[cell], &plan.of_sensors[cell]) {
                (Some(source), _) => number()
                    .and_then(|value| row.fill(source, value))
                    .map_err(|problem| source.sharpened(problem)),
                (None, Some(source)) => number().and_then(|value| row.fill_sensor(source, value)),
                (None, None) => continue,
            };
            filled.map_err(|problem| {
                Fault::new(line.place(cell).with_name(&plan.names[cell]).with_value(text), problem)
            })?;
        }
        Ok(row)
    }

    pub(crate) fn finish(mut self, name: &str) -> Result<TableReading, Fault> {
        self.table.warnings.splice(0..0, self.dialect.warnings(self.encoding));
        self.table.finish(name)
    }
}
