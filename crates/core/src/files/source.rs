//! Where the text of a table comes from: a file, standard input, a sheet of a workbook.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read, stdin};
use std::path::Path;

use super::Warning;
use super::error::Fault;
use super::spreadsheet::{is_workbook, sheet};
use super::warning::Notice;

const BUFFER_BYTES: usize = 1 << 18;

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
    let mut input: Box<dyn BufRead> = if path.as_os_str() == "-" {
        Box::new(BufReader::with_capacity(BUFFER_BYTES, stdin()))
    } else {
        Box::new(BufReader::with_capacity(BUFFER_BYTES, File::open(path)?))
    };
    if !is_workbook(input.fill_buf()?) {
        return read(input);
    }
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let sheet = sheet(&bytes, usual)?;
    let mut table = read(Box::new(Cursor::new(sheet.text.into_bytes())))
        .map_err(|fault| Fault::new(fault.place.in_sheet(&sheet.name), *fault.problem))?;
    let Some(warnings) = table.warnings() else { return Ok(table) };
    // The separator is ours.
    warnings.retain(|warning| !matches!(warning.notice, Notice::Separator(_)));
    for warning in warnings {
        warning.place = std::mem::take(&mut warning.place).in_sheet(&sheet.name);
    }
    Ok(table)
}
