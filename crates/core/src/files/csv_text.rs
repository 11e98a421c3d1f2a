//! Comma-separated text, written in one place (RFC 4180).

use std::borrow::Cow;

/// A table as comma-separated text: a header, then rows. Cells with a comma, a quote or an end of line are quoted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CsvText {
    text: String,
}

impl CsvText {
    /// A table without rows.
    pub fn new<S: AsRef<str>>(header: impl IntoIterator<Item = S>) -> Self {
        let mut table = Self::default();
        table.row(header);
        table
    }

    /// Adds a row.
    pub fn row<S: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = S>) {
        for (k, cell) in cells.into_iter().enumerate() {
            if k > 0 {
                self.text.push(',');
            }
            self.text.push_str(&csv_cell(cell.as_ref()));
        }
        self.text.push('\n');
    }

    /// The text.
    pub fn into_text(self) -> String {
        self.text
    }
}

/// A cell as it stands in a file.
pub fn csv_cell(text: &str) -> Cow<'_, str> {
    if text.contains(['"', ',', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

/// A text of a stranger that a spreadsheet leaves a text: one that would be run as a formula gets an apostrophe in front, a number does not.
///
/// Source: OWASP, CSV injection: cells that begin with `=`, `+`, `-`, `@`, a tabulator or a carriage return.
pub fn csv_words(text: &str) -> Cow<'_, str> {
    let runs = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err();
    if runs { Cow::Owned(format!("'{text}")) } else { Cow::Borrowed(text) }
}

#[cfg(test)]
mod tests {
    use super::{CsvText, csv_words};

    #[test]
    fn a_formula_stays_a_text_and_a_number_a_number() {
        for formula in ["=1+1", "+cmd", "-cmd", "@sum(A1)", "\t=1"] {
            assert_eq!(csv_words(formula), format!("'{formula}"));
        }
        for plain in ["", "-5.3", "+1e-3", "a=b", "leg 1"] {
            assert_eq!(csv_words(plain), plain);
        }
    }

    #[test]
    fn cells_that_hold_a_comma_or_a_quote_are_quoted() {
        let mut table = CsvText::new(["what", "n"]);
        table.row(["a, b", "3"]);
        table.row(["\"c\"", "4"]);
        assert_eq!(table.into_text(), "what,n\n\"a, b\",3\n\"\"\"c\"\"\",4\n");
    }
}
