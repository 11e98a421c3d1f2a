//! Reading a table of measurements from columns in memory: the checks and messages of a file.

use std::hash::{Hash, Hasher};
use std::path::Path;

use super::error::Fault;
use super::header::{GroupPurpose, Reads};
use super::line::Line;
use super::lines::RawLine;
use super::number::parse_number;
use super::row::FilledRow;
use super::table::{Table, TableReading};
use super::{FileError, FilePlace, FileProblem};
use crate::Hexapod;

/// Stands between names of columns; it is replaced in names, as are quotation marks and line ends.
const SEPARATOR: char = '\u{1f}';

/// A column in memory.
#[derive(Debug, Clone)]
pub struct MemoryColumn {
    /// Name with unit, as in a file.
    pub name: String,
    /// One cell per row.
    pub cells: Cells,
}

/// Cells of a column.
#[derive(Debug, Clone)]
pub enum Cells {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Texts, read as the cells of a file.
    Texts(Vec<String>),
}

impl Cells {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(cells) => cells.len(),
            Self::Texts(cells) => cells.len(),
        }
    }

    fn number(&self, row: usize) -> Result<f64, FileProblem> {
        match self {
            Self::Numbers(cells) if cells[row].is_finite() => Ok(cells[row]),
            Self::Numbers(_) => Err(FileProblem::NotFinite),
            Self::Texts(cells) => match parse_number(cells[row].trim())? {
                parsed if parsed.comma => Err(FileProblem::DecimalComma),
                parsed => Ok(parsed.value),
            },
        }
    }

    fn is_empty(&self, row: usize) -> bool {
        match self {
            Self::Numbers(cells) => cells[row].is_nan(),
            Self::Texts(cells) => cells[row].trim().is_empty(),
        }
    }

    fn text(&self, row: usize) -> String {
        match self {
            Self::Numbers(cells) => cells[row].to_string(),
            Self::Texts(cells) => cells[row].clone(),
        }
    }
}

/// Reads a table from memory as [`super::read_campaign`] (without a machine [`super::read_measurements`]), [`super::read_conditions`] or
/// [`super::read_plan`] read one from a file; `name` stands for the file in messages. NaN is an empty cell.
///
/// The line of an observation is that of the file which [`super::write_measurements`] would make of the table: the row, from 0,
/// and two.
///
/// # Errors
/// As for a file, with the row, from 0, in the place of the line.
pub fn read_columns(
    columns: &[MemoryColumn],
    name: &str,
    purpose: GroupPurpose,
    machine: Option<&Hexapod>,
) -> Result<TableReading, FileError> {
    table(columns, purpose, machine).and_then(|table| table.finish(name)).map_err(|fault| {
        let place = fault.place.without_line();
        Fault::new(place, *fault.problem).in_file(Path::new(name))
    })
}

fn table(columns: &[MemoryColumn], purpose: GroupPurpose, machine: Option<&Hexapod>) -> Result<Table, Fault> {
    let Some(first) = columns.first() else { return Err(Fault::new(FilePlace::file(), FileProblem::Empty)) };
    let names: Vec<String> = columns.iter().map(|column| plain(&column.name)).collect();
    let header = names.join(&SEPARATOR.to_string());
    let raw = RawLine { text: &header, number: 1, start: 0, ended: true };
    let mut borders = Vec::new();
    let mut table = Table::new(&Line::cut(raw, SEPARATOR as u8, &mut borders)?, Reads::of(purpose, machine))?;
    // There are no lines to be named.
    table.warnings.iter_mut().for_each(|w| w.place = std::mem::take(&mut w.place).without_line());
    refuse_other_lengths(first, columns)?;
    for row in 0..first.cells.len() {
        let read = read_row(columns, &table, row)?;
        table.push(&read, row as u64 + 2, &RowCells { columns, row }).map_err(|problem| {
            let place = FilePlace::cell(row, "", "");
            Fault::new(place, problem)
        })?;
    }
    Ok(table)
}

fn plain(name: &str) -> String {
    name.replace([SEPARATOR, '"', '\n', '\r'], "\u{fffd}")
}

fn refuse_other_lengths(first: &MemoryColumn, columns: &[MemoryColumn]) -> Result<(), Fault> {
    let rows = first.cells.len();
    let Some(other) = columns.iter().find(|column| column.cells.len() != rows) else { return Ok(()) };
    let rule = format!("{} has {} values, {} has {rows}", other.name, other.cells.len(), first.name);
    let next = "Give every column one value per reading.";
    Err(Fault::rule(FilePlace::file(), rule, next))
}

fn read_row(columns: &[MemoryColumn], table: &Table, row: usize) -> Result<FilledRow, Fault> {
    let plan = &table.plan;
    let mut filled = FilledRow::new();
    for (cell, column) in columns.iter().enumerate() {
        if plan.may_be_empty(cell) && column.cells.is_empty(row) {
            filled.leave_out(plan, cell);
            continue;
        }
        let put = match (&plan.sources[cell], &plan.of_sensors[cell]) {
            (Some(source), _) => column
                .cells
                .number(row)
                .and_then(|value| filled.fill(source, value))
                .map_err(|problem| source.sharpened(problem)),
            (None, Some(source)) => {
                column.cells.number(row).and_then(|value| filled.fill_sensor(source, value))
            }
            (None, None) => continue,
        };
        put.map_err(|problem| {
            Fault::new(FilePlace::cell(row, &column.name, &column.cells.text(row)), problem)
        })?;
    }
    Ok(filled)
}

/// All cells of a row.
struct RowCells<'a> {
    columns: &'a [MemoryColumn],
    row: usize,
}

impl Hash for RowCells<'_> {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        for column in self.columns {
            match &column.cells {
                Cells::Numbers(cells) => cells[self.row].to_bits().hash(hasher),
                Cells::Texts(cells) => cells[self.row].hash(hasher),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::{measurements_to_columns, measurements_to_csv, read_measurements_from};

    const HEADER: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
                          da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";

    /// The columns of a CSV text, numbers where every cell is one.
    fn columns(text: &str) -> Vec<MemoryColumn> {
        let lines = text.lines().filter(|line| !line.is_empty());
        let mut lines = lines.map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let names = lines.next().unwrap();
        let rows: Vec<_> = lines.collect();
        let of = |k: usize| {
            let texts: Vec<String> = rows.iter().map(|row| row[k].clone()).collect();
            let numbers: Result<Vec<f64>, _> = texts.iter().map(|t| t.parse()).collect();
            numbers.map_or(Cells::Texts(texts), Cells::Numbers)
        };
        names.iter().enumerate().map(|(k, name)| MemoryColumn { name: name.clone(), cells: of(k) }).collect()
    }

    fn text(rows: &[&str]) -> String {
        format!("{HEADER}\n{}\n", rows.join("\n"))
    }

    fn message(text: &str) -> String {
        read_columns(&columns(text), "frame", GroupPurpose::Measurements, None).unwrap_err().to_string()
    }

    const GOOD: [&str; 2] =
        ["1,1,1.5,2,3,0.1,0,0,0,0,-100,0,0,0,1,2,3,4,5,6", "2,1,1,2,3,0,0,-90,0,0,-100,0.3,0,0,1,2,3,4,5,7"];

    #[test]
    fn a_table_in_memory_is_read_as_its_file() {
        let text = text(&GOOD);
        let file = read_measurements_from(text.as_bytes(), "frame").unwrap();
        let memory = read_columns(&columns(&text), "frame", GroupPurpose::Measurements, None).unwrap();
        assert_eq!(memory, file);
    }

    #[test]
    fn what_is_written_as_columns_is_what_is_written_as_text() {
        let dataset =
            read_columns(&columns(&text(&GOOD)), "frame", GroupPurpose::Measurements, None).unwrap().dataset;
        let mut csv = Vec::new();
        measurements_to_csv(&mut csv, &dataset).unwrap();
        let expected = columns(std::str::from_utf8(&csv).unwrap());
        for (column, (name, values)) in expected.iter().zip(measurements_to_columns(&dataset)) {
            assert_eq!(column.name, name);
            let Cells::Numbers(cells) = &column.cells else { panic!("{name} is no column of numbers") };
            assert_eq!(*cells, values, "{name}");
        }
    }

    #[test]
    fn a_bad_cell_is_named_with_its_row() {
        let nan = message(&text(&[GOOD[0], "2,1,1,2,3,0,0,0,0,0,NaN,0,0,0,1,2,3,4,5,7"]));
        assert_eq!(nan, "frame: row 1 (fz_N): \"NaN\": NaN and infinity are not values");
        let word = message(&text(&["1,1,1,2,3,0,0,0,0,0,ten,0,0,0,1,2,3,4,5,7"]));
        assert_eq!(word, "frame: row 0 (fz_N): \"ten\": this is not a number");
        let whole = message(&text(&["1.5,1,1,2,3,0,0,0,0,0,1,0,0,0,1,2,3,4,5,7"]));
        assert_eq!(whole, "frame: row 0 (pose): \"1.5\": this must be a whole number");
    }

    #[test]
    fn what_is_wrong_with_the_columns_is_said_without_a_line() {
        let missing = message("a_mm,b_mm\n1,2\n");
        assert!(missing.starts_with("frame: no measured values"), "{missing}");
        let unit = message("a,b_mm\n1,2\n");
        assert!(unit.starts_with("frame: a: "), "{unit}");
        let strange = message("a_mm,\"x\u{1f}y\n1,2\n");
        assert!(strange.starts_with("frame: no measured values"), "{strange}");
        assert_eq!(message(&text(&[])), "frame: there is a header but no row of measurements");
        let none = read_columns(&[], "frame", GroupPurpose::Measurements, None).unwrap_err().to_string();
        assert_eq!(none, "frame: the file is empty");
    }

    #[test]
    fn columns_of_unequal_length_are_refused() {
        let mut columns = columns(&text(&GOOD));
        columns[3].cells = Cells::Numbers(vec![1.0]);
        let told = read_columns(&columns, "frame", GroupPurpose::Measurements, None).unwrap_err().to_string();
        assert_eq!(told, "frame: b_mm has 1 values, pose has 2");
    }
}
