//! Where in a file something is.

use std::fmt;
use std::ops::Range;

/// Where in a file: as much as is known, all of it counted from 1 except the bytes and the rows of a table in memory.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FilePlace {
    /// Sheet of a workbook; lines are then its rows.
    pub sheet: Option<String>,
    /// Line, the first is 1, header and comments included.
    pub line: Option<u64>,
    /// Row of a table in memory, the first is 0, as arrays count.
    pub row: Option<usize>,
    /// Column: the number of the cell in a CSV file, of the character in a TOML file.
    pub column: Option<usize>,
    /// Name of the CSV column, or the TOML key, as the file spells it.
    pub name: Option<String>,
    /// The offending text, as the file spells it (long text is shortened).
    pub value: Option<String>,
    /// Byte offsets of the offending text in the file, for a caret.
    pub span: Option<Range<usize>>,
}

/// Longest value quoted in a message, in characters.
const SHOWN_CHARACTERS: usize = 40;

impl FilePlace {
    /// The whole file.
    pub fn file() -> Self {
        Self::default()
    }

    /// A line.
    pub fn line(line: u64, span: Range<usize>) -> Self {
        Self { line: Some(line), span: Some(span), ..Self::default() }
    }

    /// A cell of a table in memory.
    pub fn cell(row: usize, name: &str, value: &str) -> Self {
        Self { row: Some(row), ..Self::default() }.with_name(name).with_value(value)
    }

    /// The same place in a table in memory, which has no lines.
    #[must_use]
    pub fn without_line(self) -> Self {
        Self { line: None, column: None, span: None, ..self }
    }

    /// The same place in a sheet of a workbook, whose bytes are not text.
    #[must_use]
    pub fn in_sheet(self, sheet: &str) -> Self {
        Self { sheet: Some(shortened(sheet)), span: None, ..self }
    }

    /// The same place in records, whose bytes are not those of the text that was read, and whose names have no line.
    #[must_use]
    pub fn in_records(self) -> Self {
        Self { line: self.line.filter(|line| *line > 0), column: None, span: None, ..self }
    }

    /// The same place with the offending text.
    #[must_use]
    pub fn with_value(self, value: &str) -> Self {
        Self { value: Some(shortened(value)), ..self }
    }

    /// The same place with the name of the column or key.
    #[must_use]
    pub fn with_name(self, name: &str) -> Self {
        Self { name: Some(shortened(name)), ..self }
    }
}

/// `line 3, column 9 (fz_N)`, `row 1 (fz_N)`; nothing for the whole file.
impl fmt::Display for FilePlace {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(sheet) = &self.sheet {
            let comma = if self.line.is_some() || self.name.is_some() { ", " } else { "" };
            write!(out, "sheet \"{sheet}\"{comma}")?;
        }
        if let Some(line) = self.line {
            let word = if self.sheet.is_some() { "row" } else { "line" };
            write!(out, "{word} {line}")?;
        }
        if let Some(row) = self.row {
            write!(out, "row {row}")?;
        }
        if let Some(column) = self.column {
            write!(out, ", column {column}")?;
        }
        match &self.name {
            Some(name) if name.is_empty() => Ok(()),
            Some(name) if self.line.is_some() || self.row.is_some() => write!(out, " ({name})"),
            Some(name) => out.write_str(name),
            None => Ok(()),
        }
    }
}

fn shortened(text: &str) -> String {
    let text = text.trim().replace(char::is_control, "\u{fffd}");
    match text.char_indices().nth(SHOWN_CHARACTERS) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}
