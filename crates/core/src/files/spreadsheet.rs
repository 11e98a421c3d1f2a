//! Sheets of a workbook (xlsx, xlsb, xls, ods) as the text of a table: a line for each row, a tab between cells.
//!
//! Everything after that is done as for text, so that a table means the same in every form. Lines are rows and cells are columns, and
//! messages name both with the sheet.

use std::fmt::Write as _;
use std::io::Cursor;

use calamine::{Data, ExcelDateTime, Range, Reader, Sheets, open_workbook_auto_from_rs};

use super::error::Fault;
use super::{FilePlace, FileProblem};

/// How files begin that are packed (xlsx, xlsb, ods) or of the older binary format (xls).
const BEGINNINGS: [&[u8]; 2] = [b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"];

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
    let mut book = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(|_| whole(damaged()))?;
    let filled = filled(&mut book).map_err(|()| whole(damaged()))?;
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

fn filled(book: &mut Sheets<Cursor<&[u8]>>) -> Result<Vec<(String, Range<Data>)>, ()> {
    let names = book.sheet_names();
    let read = |name: String| Ok((name.clone(), book.worksheet_range(&name).map_err(|_| ())?));
    let all: Vec<_> = names.into_iter().map(read).collect::<Result<_, ()>>()?;
    Ok(all.into_iter().filter(|(_, range)| range.used_cells().next().is_some()).collect())
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
