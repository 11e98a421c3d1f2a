//! Where the text of a table comes from: a file, standard input, a sheet of a workbook.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, stdin};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::error::Fault;
use super::other_formats::other_format;
use super::records::{Records, is_json, json_lines};
use super::spreadsheet::{is_workbook, sheet};
use super::warning::Notice;
use super::{FilePlace, Warning};

const BUFFER_BYTES: usize = 1 << 18;

/// True for the name of standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// All of standard input. It can be read once only, and is asked for again: for its digest.
pub(crate) fn standard_input() -> io::Result<&'static [u8]> {
    static BYTES: Mutex<Option<&'static [u8]>> = Mutex::new(None);
    let mut kept = BYTES.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.is_none() {
        let mut bytes = Vec::new();
        stdin().lock().read_to_end(&mut bytes)?;
        *kept = Some(bytes.leak());
    }
    Ok(kept.unwrap_or_default())
}

/// What a reader of text has to say besides what it read.
pub(crate) trait Noticed {
    fn warnings(&mut self) -> Option<&mut Vec<Warning>>;
}

/// Reads the table of a file; `-` is standard input. Of a workbook it is the sheet called `usual`, or the only one.
///
/// # Errors
/// What `read` says, and what is wrong with the file or the workbook.
pub(crate) fn read_source<T: Noticed>(
    path: &Path,
    usual: &str,
    read: impl FnOnce(Box<dyn BufRead>) -> Result<T, Fault>,
) -> Result<T, Fault> {
    let mut input: Box<dyn BufRead> = if is_standard_input(path) {
        Box::new(standard_input()?)
    } else {
        Box::new(BufReader::with_capacity(BUFFER_BYTES, File::open(path)?))
    };
    if is_json(input.fill_buf()?) {
        return of_records(&json_lines(input)?, read);
    }
    if let Some(problem) = other_format(input.fill_buf()?) {
        return Err(Fault::new(FilePlace::file(), problem));
    }
    if !is_workbook(input.fill_buf()?) {
        return read(input);
    }
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let sheet = sheet(&bytes, usual)?;
    let mut table = read(Box::new(Cursor::new(sheet.text.into_bytes())))
        .map_err(|fault| Fault::new(fault.place.in_sheet(&sheet.name), *fault.problem))?;
    place_warnings(&mut table, |place| place.in_sheet(&sheet.name));
    Ok(table)
}

/// Reads a table of records.
///
/// # Errors
/// What `read` says.
pub(crate) fn of_records<T: Noticed>(
    records: &Records,
    read: impl FnOnce(Box<dyn BufRead>) -> Result<T, Fault>,
) -> Result<T, Fault> {
    let mut table = read(Box::new(Cursor::new(records.text().into_bytes())))
        .map_err(|fault| Fault::new(fault.place.in_records(), *fault.problem))?;
    place_warnings(&mut table, FilePlace::in_records);
    Ok(table)
}

/// Puts warnings where the user knows them; the separator of a text made here is ours.
fn place_warnings(table: &mut impl Noticed, place: impl Fn(FilePlace) -> FilePlace) {
    let Some(warnings) = table.warnings() else { return };
    warnings.retain(|warning| !matches!(warning.notice, Notice::Separator(_)));
    for warning in warnings {
        warning.place = place(std::mem::take(&mut warning.place));
    }
}
