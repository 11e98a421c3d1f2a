//! Sheets of a workbook (xlsx, xlsb, xls, ods) as the text of a table: a line for each row, a tab between cells.
//!
//! Everything after that is done as for text, so that a table means the same in every form. Lines are rows and cells are columns, and
//! messages name both with the sheet.

use std::fmt::Write as _;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use calamine::{
    Cell, Data, DataRef, ExcelDateTime, Range, Reader, Sheets, XlsxError, open_workbook_auto_from_rs,
};

use super::error::Fault;
use super::{FilePlace, FileProblem};

/// How files begin that are packed (xlsx, xlsb, ods) or of the older binary format (xls).
const BEGINNINGS: [&[u8]; 2] = [b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"];

/// Cells from the first one to the last ones of a sheet, the empty ones among them: 64 columns of all the rows there can be. One cell far
/// from all others would fill the memory with what lies between.
const MOST_CELLS: u64 = 64 * 1_048_576;

/// A sheet as text.
pub(crate) struct Sheet {
    pub(crate) name: String,
    pub(crate) text: String,
}

/// True for the first bytes of a workbook.
pub(crate) fn is_workbook(beginning: &[u8]) -> bool {
    BEGINNINGS.iter().any(|mark| beginning.starts_with(mark))
}

/// The sheet that holds a table: the one called `usual`, or the only one that is not empty.
///
/// # Errors
/// A file that is no workbook; several sheets and none called so; none that is not empty.
pub(crate) fn sheet(bytes: &[u8], usual: &str) -> Result<Sheet, Fault> {
    let whole = |problem| Fault::new(FilePlace::file(), problem);
    // The library that unpacks workbooks stops at names of cells that no spreadsheet writes.
    let unpacked = catch_unwind(AssertUnwindSafe(|| filled(bytes)));
    let filled = unpacked.unwrap_or_else(|_| Err(damaged())).map_err(whole)?;
    let called_so = filled.iter().position(|(name, _)| name.trim().eq_ignore_ascii_case(usual));
    let chosen = match (called_so, filled.len()) {
        (Some(named), _) => named,
        (None, 1) => 0,
        (None, 0) => return Err(whole(FileProblem::Empty)),
        (None, _) => return Err(whole(several(filled.iter().map(|(name, _)| name.as_str()), usual))),
    };
    let (name, range) = &filled[chosen];
    Ok(Sheet { name: name.clone(), text: text(range) })
}

fn filled(bytes: &[u8]) -> Result<Vec<(String, Range<Data>)>, FileProblem> {
    let mut book = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(|_| damaged())?;
    let names = Reader::sheet_names(&book);
    let read = |name: String| {
        let cells = cells(&mut book, &name)?;
        Ok((name, cells))
    };
    let all: Vec<_> = names.into_iter().map(read).collect::<Result<_, FileProblem>>()?;
    Ok(all.into_iter().filter(|(_, range)| range.used_cells().next().is_some()).collect())
}

/// What is in a sheet; nothing in a chart.
fn cells(book: &mut Sheets<Cursor<&[u8]>>, name: &str) -> Result<Range<Data>, FileProblem> {
    let value = |cell: Cell<DataRef<'_>>| (cell.get_position(), Data::from(cell.get_value().clone()));
    match book {
        Sheets::Xlsx(book) => match book.worksheet_cells_reader(name) {
            Ok(mut reader) => gathered(name, || reader.next_cell().map(|cell| cell.map(value))),
            Err(XlsxError::NotAWorksheet(_)) => Ok(Range::empty()),
            Err(_) => Err(damaged()),
        },
        Sheets::Xlsb(book) => {
            let mut reader = book.worksheet_cells_reader(name).map_err(|_| damaged())?;
            gathered(name, || reader.next_cell().map(|cell| cell.map(value)))
        }
        Sheets::Xls(_) | Sheets::Ods(_) => book.worksheet_range(name).map_err(|_| damaged()),
    }
}

/// Cells that come one by one, with row and column from zero.
fn gathered<E>(
    name: &str,
    mut next: impl FnMut() -> Result<Option<((u32, u32), Data)>, E>,
) -> Result<Range<Data>, FileProblem> {
    let (mut cells, mut rows, mut columns) = (Vec::new(), 0, 0);
    while let Some((at, value)) = next().map_err(|_| damaged())? {
        if value == Data::Empty {
            continue;
        }
        (rows, columns) = (u64::from(at.0).max(rows), u64::from(at.1).max(columns));
        if (rows + 1).saturating_mul(columns + 1) > MOST_CELLS {
            return Err(too_far(name, at));
        }
        cells.push(Cell::new(at, value));
    }
    Ok(Range::from_sparse(cells))
}

fn too_far(name: &str, (row, column): (u32, u32)) -> FileProblem {
    let (row, column) = (u64::from(row) + 1, u64::from(column) + 1);
    FileProblem::Rule {
        rule: format!(
            "sheet \"{name}\" has a cell in row {row}, column {column}, too far from the first one for a table"
        ),
        next: "Delete the rows and columns beyond the table, and save the workbook again.".into(),
    }
}

fn damaged() -> FileProblem {
    FileProblem::Rule {
        rule: "this is no workbook that can be read: damaged, protected by a password, or packed for another purpose".into(),
        next: "Save it again as .xlsx or .ods without a password, or export the sheet as CSV.".into(),
    }
}

fn several<'a>(names: impl Iterator<Item = &'a str>, usual: &str) -> FileProblem {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    FileProblem::Rule {
        rule: format!("the workbook has {} sheets that are not empty: {}", names.len(), names.join(", ")),
        next: format!("Call the one to be read \"{usual}\", or keep it alone in a workbook."),
    }
}

/// Rows above and columns before the first filled cell are kept, so that counts are those of the sheet.
fn text(range: &Range<Data>) -> String {
    let (top, left) = range.start().unwrap_or_default();
    let mut text = "\n".repeat(top as usize);
    for row in range.rows() {
        text.push_str(&"\t".repeat(left as usize));
        let last = row.iter().rposition(|cell| *cell != Data::Empty).map_or(0, |last| last + 1);
        for (k, cell) in row[..last].iter().enumerate() {
            if k > 0 {
                text.push('\t');
            }
            write(&mut text, cell);
        }
        // A row is as long as the table, but empty rows are blank lines.
        if last > 0 {
            text.push_str(&"\t".repeat(row.len() - last));
        }
        text.push('\n');
    }
    text
}

/// A cell as someone would have typed it. Writing into a String cannot fail.
fn write(text: &mut String, cell: &Data) {
    let _ = match cell {
        Data::Empty => Ok(()),
        Data::Int(number) => write!(text, "{number}"),
        Data::Float(number) => write!(text, "{number}"),
        Data::Bool(yes) => write!(text, "{}", if *yes { "TRUE" } else { "FALSE" }),
        // A first cell of #DIV/0! would make its row a comment.
        Data::Error(error) => write!(text, "error {error}"),
        Data::DateTime(date) => write!(text, "{}", instant(*date)),
        Data::DateTimeIso(date) => write!(text, "{}", date.get(..10).unwrap_or(date)),
        Data::DurationIso(time) => write!(text, "{time}"),
        Data::String(words) => {
            text.extend(words.chars().map(plain));
            Ok(())
        }
    };
}

/// What would cut a cell or a line.
fn plain(symbol: char) -> char {
    match symbol {
        '\t' | '\n' | '\r' => ' ',
        '"' => '\u{201d}',
        other => other,
    }
}

fn instant(date: ExcelDateTime) -> String {
    let (year, month, day, hour, minute, second, _) = date.to_ymd_hms_milli();
    if date.is_datetime() && date.as_f64() >= 1.0 {
        format!("{year:04}-{month:02}-{day:02}")
    } else {
        format!("{hour:02}:{minute:02}:{second:02}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_in_the_last_corner_of_a_sheet_is_refused_before_memory_is_filled() {
        let read = |last: (u32, u32)| {
            let mut all = [(0, 0), last].map(|at| (at, Data::Float(1.0))).into_iter();
            gathered("plan", || Ok::<_, ()>(all.next()))
        };
        assert_eq!(read((9, 3)).unwrap().get_size(), (10, 4));
        let Err(FileProblem::Rule { rule, .. }) = read((1_048_575, 16_383)) else { panic!("it is read") };
        assert!(rule.contains("\"plan\" has a cell in row 1048576, column 16384"), "{rule}");
        assert!(read((u32::MAX, u32::MAX)).is_err());
    }
}
