//! Tables that are kept as records, each with the names of its values: JSON lines, Parquet.
//!
//! They become the text of a table, so that a table means the same in every form. A record has the number of its line; the names, which have
//! no line of their own, have none.

use std::io::BufRead;

use serde_json::{Map, Value};

use super::FilePlace;
use super::error::Fault;

/// How the text of records begins: its first line is not counted.
pub(crate) const MARK: u8 = 0x1e;

/// Names of columns, and rows of cells; none: empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Records {
    /// Names of the columns, with units.
    pub names: Vec<String>,
    /// Cells as text, row by row.
    pub rows: Vec<Vec<Option<String>>>,
}

impl Records {
    /// The text of a table: a tab between cells.
    pub(crate) fn text(&self) -> String {
        let line = |cells: &mut dyn Iterator<Item = &str>| {
            let plain = |cell: &str| cell.replace(['\t', '\n', '\r'], " ").replace('"', "\u{201d}");
            cells.map(plain).collect::<Vec<_>>().join("\t") + "\n"
        };
        let names = line(&mut self.names.iter().map(String::as_str));
        let rows =
            self.rows.iter().map(|row| line(&mut row.iter().map(|c| c.as_deref().unwrap_or_default())));
        char::from(MARK).to_string() + &names + &rows.collect::<String>()
    }
}

/// True for the first bytes of JSON.
pub(crate) fn is_json(beginning: &[u8]) -> bool {
    let beginning = beginning.strip_prefix(b"\xef\xbb\xbf").unwrap_or(beginning);
    beginning.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{')
}

/// Reads JSON lines: an object on every line, with numbers, words or null.
///
/// # Errors
/// A line that is no such object, or has other names than the first.
pub(crate) fn json_lines(input: impl BufRead) -> Result<Records, Fault> {
    let mut records = Records::default();
    for (number, line) in (1..).zip(input.lines()) {
        let line = line?;
        let line = line.trim_start_matches('\u{feff}');
        if line.trim().is_empty() {
            // Blank lines keep their numbers.
            records.rows.push(vec![None; records.names.len()]);
            continue;
        }
        let fault = |rule: String, next: &str| {
            let place = FilePlace { line: Some(number), ..FilePlace::file() };
            Fault::rule(place, rule, next)
        };
        let object: Map<String, Value> = serde_json::from_str(line).map_err(|wrong| {
            fault(
                format!("this line is no JSON object ({wrong})"),
                "Write one object a line: {\"pose\": 1, \"a_mm\": 0, ...}. A file that is one JSON value is not a table.",
            )
        })?;
        if records.names.is_empty() {
            records.names = object.keys().cloned().collect();
        }
        if let Some(other) = object.keys().find(|key| !records.names.contains(key)) {
            return Err(fault(
                format!("{other} is not in the first object"),
                "Give every object the same names; null is a reading that was not taken.",
            ));
        }
        let mut row = Vec::with_capacity(records.names.len());
        for name in &records.names {
            row.push(match object.get(name) {
                None | Some(Value::Null) => None,
                Some(Value::Number(value)) => Some(value.to_string()),
                Some(Value::String(value)) => Some(value.clone()),
                Some(_) => {
                    return Err(fault(format!("{name} is no number"), "Give numbers, words or null."));
                }
            });
        }
        records.rows.push(row);
    }
    Ok(records)
}
