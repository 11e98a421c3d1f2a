//! One line of a table, cut into cells.

use super::error::Fault;
use super::lines::RawLine;
use super::{FilePlace, FileProblem};
use std::ops::Range;

/// A line and its cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line<'a> {
    raw: RawLine<'a>,
    cells: &'a [Range<usize>],
}

impl<'a> Line<'a> {
    /// Cuts the line at the separators; `cells` is the memory for their borders.
    pub(crate) fn cut(
        raw: RawLine<'a>,
        separator: u8,
        cells: &'a mut Vec<Range<usize>>,
    ) -> Result<Self, Fault> {
        cells.clear();
        if memchr::memchr(b'"', raw.text.as_bytes()).is_none() {
            cut_plain(raw.text.as_bytes(), separator, cells);
        } else {
            cut_quoted(raw, separator, cells)?;
        }
        Ok(Self { raw, cells })
    }

    /// The line without the empty cells at its end.
    pub(crate) fn trimmed(self) -> Self {
        let used = (0..self.len()).rev().find(|cell| !self.text(*cell).is_empty()).map_or(0, |last| last + 1);
        Self { cells: &self.cells[..used], ..self }
    }

    /// The line without empty cells beyond so many.
    pub(crate) fn without_empty_beyond(self, cells: usize) -> Self {
        let used = self.trimmed().len().max(cells).min(self.len());
        Self { cells: &self.cells[..used], ..self }
    }

    /// Number of cells.
    pub(crate) fn len(&self) -> usize {
        self.cells.len()
    }

    /// Number of the line.
    pub(crate) fn number(&self) -> u64 {
        self.raw.number
    }

    /// Text of a cell without blanks around it.
    pub(crate) fn text(&self, cell: usize) -> &'a str {
        self.raw.text[self.cells[cell].clone()].trim()
    }

    /// Where the cell is.
    pub(crate) fn place(&self, cell: usize) -> FilePlace {
        let text = self.text(cell);
        let cut = &self.cells[cell];
        let blanks = self.raw.text[cut.clone()].len() - self.raw.text[cut.clone()].trim_start().len();
        let start = self.raw.start + cut.start + if text.is_empty() { 0 } else { blanks };
        FilePlace { column: Some(cell + 1), ..FilePlace::line(self.raw.number, start..start + text.len()) }
    }

    /// Where the line is.
    pub(crate) fn whole_place(&self) -> FilePlace {
        whole_place(&self.raw)
    }
}

pub(crate) fn whole_place(raw: &RawLine<'_>) -> FilePlace {
    FilePlace::line(raw.number, raw.start..raw.start + raw.text.len())
}

fn cut_plain(text: &[u8], separator: u8, cells: &mut Vec<Range<usize>>) {
    let mut start = 0;
    for end in memchr::memchr_iter(separator, text) {
        cells.push(start..end);
        start = end + 1;
    }
    cells.push(start..text.len());
}

/// Cells in quotation marks lose them; a doubled mark inside stays doubled (such cells are names or notes).
fn cut_quoted(raw: RawLine<'_>, separator: u8, cells: &mut Vec<Range<usize>>) -> Result<(), Fault> {
    let text = raw.text.as_bytes();
    let (mut start, mut open) = (0, false);
    for (at, byte) in text.iter().enumerate() {
        match byte {
            b'"' => open = !open,
            byte if *byte == separator && !open => {
                cells.push(unquoted(raw.text, start..at));
                start = at + 1;
            }
            _ => {}
        }
    }
    if open {
        return Err(Fault::new(whole_place(&raw), FileProblem::OpenQuote));
    }
    cells.push(unquoted(raw.text, start..text.len()));
    Ok(())
}

fn unquoted(text: &str, cell: Range<usize>) -> Range<usize> {
    let blanks = text[cell.clone()].len() - text[cell.clone()].trim_start().len();
    let inside = text[cell.clone()].trim();
    match inside.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        Some(bare) => {
            let start = cell.start + blanks + 1;
            start..start + bare.len()
        }
        None => cell,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells_of(text: &str) -> Vec<String> {
        let mut cells = Vec::new();
        let raw = RawLine { text, number: 1, start: 0, ended: true };
        let line = Line::cut(raw, b',', &mut cells).unwrap();
        (0..line.len()).map(|cell| line.text(cell).to_owned()).collect()
    }

    #[test]
    fn quotes_hide_separators_and_blanks_do_not_count() {
        assert_eq!(cells_of("1, 2 ,,\"a,b\", \"3\""), ["1", "2", "", "a,b", "3"]);
    }

    #[test]
    fn the_place_of_a_cell_is_its_text() {
        let mut cells = Vec::new();
        let raw = RawLine { text: "1, \"x\" ,z", number: 4, start: 10, ended: true };
        let place = Line::cut(raw, b',', &mut cells).unwrap().place(1);
        assert_eq!((place.line, place.column, place.span), (Some(4), Some(2), Some(14..15)));
    }
}
