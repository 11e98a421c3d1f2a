//! Tables of results, for pages, documents and programs.

use std::fmt::Write;

/// A table of words and numbers already written out.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sheet {
    /// Names of the columns.
    pub header: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl Sheet {
    /// An empty table.
    pub fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// As a table of Markdown; columns of numbers are right-aligned.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let rule = |k: usize| if self.holds_numbers(k) { "---:" } else { "---" }.to_owned();
        let rule: Vec<String> = (0..self.header.len()).map(rule).collect();
        let mut text = line(&self.header) + &line(&rule);
        self.rows.iter().for_each(|row| text += &line(row));
        text
    }

    /// True when every cell of a column begins like a number, or is a dash for none.
    fn holds_numbers(&self, column: usize) -> bool {
        let begins = |cell: &String| cell.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        self.rows.iter().filter_map(|row| row.get(column)).all(begins)
    }

    /// As comma-separated values; cells with a comma or a quote are quoted.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        for row in std::iter::once(&self.header).chain(&self.rows) {
            let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::Sheet;

    #[test]
    fn a_sheet_is_a_table_of_markdown_and_of_commas() {
        let mut sheet = Sheet::new(&["what", "n"]);
        sheet.row(["a, b", "3"]);
        assert_eq!(sheet.markdown(), "| what | n |\n| --- | ---: |\n| a, b | 3 |\n");
        assert_eq!(sheet.csv(), "what,n\n\"a, b\",3\n");
    }
}
