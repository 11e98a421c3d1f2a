//! What a section shows.

use serde::Serialize;

/// Part of a section.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Block {
    /// A word in colour and a sentence.
    Verdict {
        /// The word.
        word: String,
        /// Its colour.
        mood: Mood,
        /// The sentence.
        text: String,
    },
    /// Text.
    Paragraph {
        /// The text.
        text: String,
    },
    /// One line each.
    List {
        /// The lines.
        items: Vec<String>,
    },
    /// Header and rows; numbers are set right.
    Table {
        /// One title a column.
        header: Vec<String>,
        /// The rows.
        rows: Vec<Vec<Cell>>,
    },
    /// A chart.
    Figure {
        /// Its name within the section, as in the names of files; empty for the only one.
        name: String,
        /// The chart, as [`crate::plot`] draws it.
        svg: String,
        /// What it shows.
        caption: String,
    },
}

/// Colour of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mood {
    /// Settled.
    Good,
    /// Open.
    Doubt,
    /// Something is wrong.
    Bad,
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cell {
    text: String,
    /// Words are set left and may wrap.
    words: bool,
    /// Length of a bar instead of text, percent.
    bar: Option<f64>,
}

impl Cell {
    /// A number or a name.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), words: false, bar: None }
    }

    /// A sentence.
    pub fn words(text: impl Into<String>) -> Self {
        Self { text: text.into(), words: true, bar: None }
    }

    /// A bar of a share of the column, 0 to 1.
    pub fn bar(share: f64) -> Self {
        Self { text: String::new(), words: false, bar: Some((1000.0 * share.clamp(0.0, 1.0)).round() / 10.0) }
    }
}

impl Block {
    /// Text.
    pub fn paragraph(text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into() }
    }

    /// A list.
    pub fn list<S: Into<String>>(items: impl IntoIterator<Item = S>) -> Self {
        Self::List { items: items.into_iter().map(Into::into).collect() }
    }

    /// A table.
    pub fn table<S: Into<String>>(
        header: impl IntoIterator<Item = S>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        Self::Table { header: header.into_iter().map(Into::into).collect(), rows: rows.into_iter().collect() }
    }

    /// The only chart of a section.
    pub fn figure(svg: String, caption: impl Into<String>) -> Self {
        Self::named_figure("", svg, caption)
    }

    /// One of several charts of a section: lower-case letters and hyphens.
    pub fn named_figure(name: impl Into<String>, svg: String, caption: impl Into<String>) -> Self {
        Self::Figure { name: name.into(), svg, caption: caption.into() }
    }
}
