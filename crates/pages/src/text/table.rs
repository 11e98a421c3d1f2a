//! Small tables with aligned columns.

/// Rows of cells; the first column is left-aligned, the others right-aligned unless said otherwise.
#[derive(Debug, Default)]
pub struct Table {
    rows: Vec<Vec<String>>,
    left: Option<usize>,
}

impl Table {
    /// Add a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The same table with one more column left-aligned.
    #[must_use]
    pub fn left(self, column: usize) -> Self {
        Self { left: Some(column), ..self }
    }

    /// The lines, indented by two, columns two apart.
    pub fn lines(&self) -> Vec<String> {
        let widths = self.widths();
        self.rows.iter().map(|row| self.aligned(row, &widths)).collect()
    }

    fn widths(&self) -> Vec<usize> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |k: usize| self.rows.iter().filter_map(|r| r.get(k)).map(|c| c.chars().count()).max();
        (0..columns).map(|k| width(k).unwrap_or(0)).collect()
    }

    fn aligned(&self, row: &[String], widths: &[usize]) -> String {
        let cell = |(k, text): (usize, &String)| {
            let gap = " ".repeat(widths[k].saturating_sub(text.chars().count()));
            if k == 0 || self.left == Some(k) { format!("{text}{gap}") } else { format!("{gap}{text}") }
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        format!("  {}", cells.join("  "))
    }
}
