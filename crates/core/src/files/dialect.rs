//! How a file writes its table: where the names of the columns are, what is between cells, which lines hold no row.

use std::io::BufRead;

use super::column_name::{Named, read_column_name};
use super::error::Fault;
use super::line::Line;
use super::lines::{Lines, RawLine};
use super::next_step::FILES_IN_ORDER;
use super::number::{Decimals, parse_number};
use super::warning::Notice;
use super::{FilePlace, FileProblem, Warning};

/// What all rows of a table have in common.
pub(crate) struct Dialect {
    pub(crate) separator: u8,
    decimals: Decimals,
    /// The line that names the columns, as it stands in the file.
    header: String,
    header_line: u64,
    /// Lines that repeat it.
    again: Vec<u64>,
    /// What a separator other than the comma is called, unless the file states it.
    named_separator: Option<&'static str>,
}

/// What a line below the names of the columns is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineKind {
    Row,
    /// The names of the columns again, word for word.
    Names,
    /// Blank, a comment, or empty cells.
    Nothing,
}

impl Dialect {
    /// Finds the line that names the columns, and reads it by `read`.
    ///
    /// # Errors
    /// What `read` says; a file without such a line, or of another kind.
    pub(crate) fn start<R: BufRead, T>(
        lines: &mut Lines<R>,
        read: impl FnOnce(&Line<'_>, Self) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let mut told = None;
        while let Some(raw) = lines.next_line()? {
            if raw.text.trim().is_empty() || raw.text.starts_with('#') {
                continue;
            }
            if told.is_none() && raw.number <= 1 {
                told = told_separator(raw.text);
                if told.is_some() {
                    continue;
                }
            }
            if raw.text.contains('\r') {
                return Err(Fault::new(FilePlace::file(), FileProblem::CarriageReturnLines));
            }
            refuse_other_kind(&raw)?;
            let dialect = Self::of(&raw, told);
            if is_blank(raw.text, dialect.separator) {
                continue;
            }
            let (names_columns, mut borders) = (is_table(raw.text), Vec::new());
            let line = Line::cut(raw, dialect.separator, &mut borders)?.trimmed();
            refuse_groups(&line)?;
            return match refuse_numbers(&line).and_then(|()| read(&line, dialect)) {
                Err(fault) if !names_columns => Err(title(lines, fault)),
                done => done,
            };
        }
        Err(Fault::new(FilePlace::file(), FileProblem::Empty))
    }

    fn of(header: &RawLine<'_>, told: Option<u8>) -> Self {
        let (separator, named_separator) =
            told.map_or_else(|| separator_of(header.text), |separator| (separator, None));
        Self {
            separator,
            decimals: Decimals::default(),
            header: header.text.to_owned(),
            header_line: header.number,
            again: Vec::new(),
            named_separator,
        }
    }

    /// What a line is; names that come again are counted.
    pub(crate) fn kind(&mut self, raw: &RawLine<'_>) -> LineKind {
        if self.is_skipped(raw.text) {
            LineKind::Nothing
        } else if raw.text == self.header {
            self.again.push(raw.number);
            LineKind::Names
        } else {
            LineKind::Row
        }
    }

    /// Blank lines, comments, and the rows of empty cells that spreadsheets leave below a table.
    fn is_skipped(&self, text: &str) -> bool {
        match text.bytes().next() {
            None => true,
            Some(b'#') => !self.begins_with_an_error(text),
            Some(byte) if byte == self.separator || byte.is_ascii_whitespace() => {
                is_blank(text, self.separator)
            }
            Some(_) => false,
        }
    }

    /// True for a row whose first cell a spreadsheet could not compute or show (`#N/A`, `#REF!`, `###`), which is no comment.
    fn begins_with_an_error(&self, text: &str) -> bool {
        let Some(end) = memchr::memchr(self.separator, text.as_bytes()) else { return false };
        let cell = text[..end].trim();
        let is_filled = cell.len() > 1 && cell.bytes().all(|byte| byte == b'#');
        let is_code = cell.len() > 1 && !cell[1..].contains([' ', '#']);
        is_filled || is_code && (cell.ends_with(['!', '?']) || ["#N/A", "#NV", "#N/D"].contains(&cell))
    }

    /// A number of a cell. A decimal comma is read where it cannot be a separator, and where no other number has a point.
    pub(crate) fn number(&mut self, text: &str, line: u64) -> Result<f64, FileProblem> {
        let parsed = parse_number(text)?;
        if self.separator != b',' {
            self.decimals.note(text, parsed, line)?;
        } else if parsed.comma {
            return Err(FileProblem::DecimalComma);
        }
        Ok(parsed.value)
    }

    /// Why a line is no row, where that is more than one wrong cell.
    pub(crate) fn explained(line: &Line<'_>, fault: Fault) -> Fault {
        let of_line = fault.place.line == Some(line.number());
        let is_about_cells = matches!(
            *fault.problem,
            FileProblem::CellCount { .. }
                | FileProblem::Truncated { .. }
                | FileProblem::EmptyCell
                | FileProblem::EmptyOptionalCell
                | FileProblem::NotANumber
                | FileProblem::NotWhole
                | FileProblem::NoValue
        );
        match what_else(line).filter(|_| of_line && is_about_cells) {
            Some((rule, next)) => Fault::rule(line.whole_place(), rule, next),
            None => fault,
        }
    }

    /// What was noticed of the whole table.
    pub(crate) fn warnings(&self, encoding: Option<&'static str>) -> Vec<Warning> {
        let whole = |notice| Warning::new(FilePlace::file(), notice);
        let header = FilePlace { line: Some(self.header_line), ..FilePlace::file() };
        let separator = self.named_separator.map(|name| Warning::new(header, Notice::Separator(name)));
        let again = (!self.again.is_empty()).then(|| whole(Notice::NamesAgain { lines: self.again.clone() }));
        let comma = self.decimals.has_comma().then(|| whole(Notice::DecimalComma));
        let encoding = encoding.map(|name| whole(Notice::Encoding(name)));
        [separator, again, encoding, comma].into_iter().flatten().collect()
    }
}

/// What a first line such as `sep=;` says, which spreadsheets write and read.
fn told_separator(text: &str) -> Option<u8> {
    let word = text.get(..4).filter(|word| word.eq_ignore_ascii_case("sep="))?;
    match text.as_bytes()[word.len()..].trim_ascii_end() {
        [separator @ (b',' | b';')] => Some(*separator),
        [] if text.ends_with('\t') => Some(b'\t'),
        _ => None,
    }
}

/// The most frequent of comma, semicolon and tab in the header, and its name unless it is the comma.
fn separator_of(header: &str) -> (u8, Option<&'static str>) {
    let count = |separator: u8| memchr::memchr_iter(separator, header.as_bytes()).count();
    let (commas, semicolons, tabs) = (count(b','), count(b';'), count(b'\t'));
    if semicolons > commas && semicolons >= tabs {
        (b';', Some("semicolons"))
    } else if tabs > commas {
        (b'\t', Some("tabs"))
    } else {
        (b',', None)
    }
}

fn is_blank(text: &str, separator: u8) -> bool {
    text.bytes().all(|byte| byte == separator || byte.is_ascii_whitespace())
}

/// A file that is no table of text although it is text.
fn refuse_other_kind(raw: &RawLine<'_>) -> Result<(), Fault> {
    let text = raw.text.trim();
    let (rule, next) = if text.starts_with('<') {
        (
            "this is a web page or XML, not a table of text",
            "Open it in a spreadsheet, and save it as .xlsx, .ods or CSV.",
        )
    } else if text.starts_with("%PDF") {
        ("this is a PDF", "Export the table itself, as text, .xlsx or CSV.")
    } else if text == "[" || text.starts_with("[{") {
        (
            "this is one list of JSON, not lines of it",
            "Write one object a line without the list around them (pandas: to_json(orient=\"records\", lines=True)).",
        )
    } else {
        return Ok(());
    };
    Err(Fault::rule(FilePlace::file(), rule, next))
}

/// True for text whose first line names columns.
pub(super) fn is_table(text: &str) -> bool {
    let is_known = |cell: &str| matches!(read_column_name(cell.trim_matches('"')), Ok(Named::Known(..)));
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| line.split([',', ';', '\t']).filter(|cell| is_known(cell)).count() > 2)
}

/// What is wrong with a first line where one of the next names the columns: it is a title.
fn title<R: BufRead>(lines: &mut Lines<R>, fault: Fault) -> Fault {
    const TITLES: usize = 10;
    let Some(first) = fault.place.line else { return fault };
    for _ in 0..TITLES {
        let Ok(Some(raw)) = lines.next_line() else { return fault };
        if is_table(raw.text) {
            let place = FilePlace { line: Some(first), ..FilePlace::file() };
            let names = raw.number;
            return Fault::rule(
                place,
                format!("this is not a row of column names; they seem to be in line {names}"),
                format!("Remove what stands above line {names}, or begin those lines with #."),
            );
        }
    }
    fault
}

/// True for a line of TOML: a table of it, or a key and its value.
fn is_toml(line: &str) -> bool {
    line.starts_with('[') || line.split_once('=').is_some_and(|(key, _)| !key.trim().contains(' '))
}

/// A first line that names no columns.
fn refuse_numbers(line: &Line<'_>) -> Result<(), Fault> {
    if line.len() == 1 && is_toml(line.text(0)) {
        return Err(Fault::rule(FilePlace::file(), "this is a TOML file, not a table", FILES_IN_ORDER));
    }
    let all_numbers = (0..line.len()).all(|cell| line.text(cell).parse::<f64>().is_ok());
    let problem = match line.len() {
        _ if all_numbers => FileProblem::NoHeader,
        1 => FileProblem::NoSeparator,
        _ => return Ok(()),
    };
    Err(Fault::new(line.whole_place(), problem))
}

/// A line of merged cells, each above several columns.
fn refuse_groups(line: &Line<'_>) -> Result<(), Fault> {
    let empty = (0..line.len()).filter(|cell| line.text(*cell).is_empty()).count();
    if 2 * empty <= line.len() {
        return Ok(());
    }
    Err(Fault::rule(
        line.whole_place(),
        "most cells of this line are empty: it is a title, or names groups of columns instead of columns",
        "Remove it, or begin it with #; put the names of the columns in one line, with their units.",
    ))
}

/// Words before a sum, a mean or another number about all rows.
const STATISTICS: [&str; 25] = [
    "sum",
    "total",
    "mean",
    "average",
    "avg",
    "std",
    "stdev",
    "std dev",
    "min",
    "max",
    "median",
    "count",
    "summe",
    "gesamt",
    "mittelwert",
    "mittel",
    "standardabweichung",
    "somme",
    "moyenne",
    "écart-type",
    "suma",
    "media",
    "promedio",
    "totale",
    "range",
];
/// How other programs begin a comment.
const COMMENTS: [&str; 4] = ["//", "%", "!", "--"];

/// What a line is instead of a row, and what to do.
fn what_else(line: &Line<'_>) -> Option<(&'static str, &'static str)> {
    let filled: Vec<&str> =
        (0..line.len()).map(|cell| line.text(cell)).filter(|text| !text.is_empty()).collect();
    let is_statistics = |text: &&str| {
        let word = text.split([':', '=']).next().unwrap_or_default().trim().to_lowercase();
        STATISTICS.contains(&word.trim_end_matches('.'))
    };
    let names = filled.iter().filter(|text| matches!(read_column_name(text), Ok(Named::Known(..)))).count();
    if filled.first().is_some_and(|first| {
        COMMENTS.iter().any(|mark| first.starts_with(mark)) && first.parse::<f64>().is_err()
    }) {
        Some(("this seems to be a comment", "Begin comments with #."))
    } else if names > 2 && 2 * names > filled.len() {
        Some((
            "the columns are named again here, otherwise than above",
            "Give each table a file of its own; names that are the same word for word may come again.",
        ))
    } else if filled.iter().any(is_statistics) {
        Some((
            "this is a sum, a mean or the like, not a reading",
            "Remove the line, or begin it with #; every line below the names is read as a reading.",
        ))
    } else {
        None
    }
}
