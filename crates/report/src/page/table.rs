//! The one table that people read.

use serde::Serialize;

use super::Mood;

/// Columns and rows; a title may stand above.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Table {
    /// What stands above it; empty for none.
    pub title: String,
    /// The columns.
    pub columns: Vec<PageColumn>,
    /// Cells, row by row; cells missing at the end of a row are empty.
    pub rows: Vec<Vec<Cell>>,
    /// Rows that every medium shows, the others are detail; none: all.
    pub brief: Option<usize>,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct PageColumn {
    /// Its heading.
    pub title: String,
    /// Words are set left and may wrap, numbers right.
    pub words: bool,
    /// Left out where there is little room.
    pub detail: bool,
}

/// A cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(untagged)]
pub enum Cell {
    /// Words or a number written out.
    Text(String),
    /// A bar of a share of the column, 0 to 1.
    Bar {
        /// Its length.
        bar: f64,
        /// Its color, if any.
        mood: Option<Mood>,
        /// Where a line crosses the column, 0 to 1, if one does.
        mark: Option<f64>,
    },
}

impl PageColumn {
    /// A column of numbers.
    pub fn number(title: impl Into<String>) -> Self {
        Self { title: title.into(), words: false, detail: false }
    }

    /// A column of words.
    pub fn words(title: impl Into<String>) -> Self {
        Self { words: true, ..Self::number(title) }
    }

    /// A column of bars.
    pub fn bars() -> Self {
        Self::words("")
    }

    /// The same column, left out where there is little room.
    #[must_use]
    pub fn detail(self) -> Self {
        Self { detail: true, ..self }
    }
}

impl Cell {
    /// A bar of a share of the column, 0 to 1.
    pub fn bar(share: f64) -> Self {
        Self::Bar { bar: stepped(share), mood: None, mark: None }
    }

    /// A bar of a multiple of the noise in a column that ends with another multiple, with a line at the noise.
    pub fn times_noise(times: f64, largest: f64) -> Self {
        Self::Bar { bar: stepped(times / largest), mood: None, mark: Some(stepped(largest.recip())) }
    }

    /// The same in color.
    pub fn colored_bar(share: f64, mood: Mood) -> Self {
        match Self::bar(share) {
            Self::Bar { bar, mark, .. } => Self::Bar { bar, mood: Some(mood), mark },
            text @ Self::Text(_) => text,
        }
    }

    /// Its words; none for a bar.
    pub fn text(&self) -> &str {
        match self {
            Self::Text(text) => text,
            Self::Bar { .. } => "",
        }
    }
}

/// A share of a column, to more digits than anybody sees.
fn stepped(share: f64) -> f64 {
    const STEPS: f64 = 1000.0;
    (STEPS * share.clamp(0.0, 1.0)).round() / STEPS
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<&String> for Cell {
    fn from(text: &String) -> Self {
        Self::Text(text.clone())
    }
}

impl Table {
    /// A table without rows.
    pub fn new(columns: impl IntoIterator<Item = PageColumn>) -> Self {
        Self { columns: columns.into_iter().collect(), ..Self::default() }
    }

    /// A table of texts: names in the first column, numbers in the others.
    pub fn named<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        let column = |(k, title): (usize, S)| {
            if k == 0 { PageColumn::words(title) } else { PageColumn::number(title) }
        };
        Self::new(header.into_iter().enumerate().map(column))
    }

    /// The same table with words in one more column.
    #[must_use]
    pub fn words_in(mut self, column: usize) -> Self {
        if let Some(c) = self.columns.get_mut(column) {
            c.words = true;
        }
        self
    }

    /// The same table with a title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The same table, whose rows beyond the first `brief` are detail.
    #[must_use]
    pub fn brief(self, brief: usize) -> Self {
        Self { brief: Some(brief), ..self }
    }

    /// Adds a row.
    pub fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The same table with these rows behind its own.
    #[must_use]
    pub fn rows<C: Into<Cell>, R: IntoIterator<Item = C>>(
        mut self,
        rows: impl IntoIterator<Item = R>,
    ) -> Self {
        rows.into_iter().for_each(|row| self.row(row));
        self
    }

    /// The text of a cell; empty where there is none.
    pub fn text(&self, row: usize, column: usize) -> &str {
        self.rows.get(row).and_then(|r| r.get(column)).map_or("", Cell::text)
    }

    /// True when any column has a heading.
    pub fn has_header(&self) -> bool {
        self.columns.iter().any(|c| !c.title.is_empty())
    }
}
