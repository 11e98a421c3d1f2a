//! What a section says.

use serde::Serialize;

use super::Table;
use crate::plot::{Panels, PlotError};

/// Part of a section.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Block {
    /// The answer: a word in color, then sentences.
    Verdict {
        /// The word.
        word: String,
        /// Its color.
        mood: Mood,
        /// One paragraph each.
        sentences: Vec<String>,
    },
    /// Text. Names of commands and files stand between backticks, in every text.
    Paragraph {
        /// The text.
        text: String,
        /// Its color, if any.
        mood: Option<Mood>,
    },
    /// A line each.
    List {
        /// The lines.
        items: Vec<String>,
    },
    /// Names with what is said of each.
    Entries {
        /// Number of a numbered group of entries.
        number: Option<usize>,
        /// The entries.
        entries: Vec<Definition>,
    },
    /// Lines as they are: commands, equations.
    Code {
        /// The lines.
        text: String,
    },
    /// Rows and columns.
    Table(Table),
    /// A chart.
    Figure(Figure),
}

/// Color of a word, a bar or a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Mood {
    /// Settled, at the noise.
    Good,
    /// Open.
    Doubt,
    /// Something is wrong, above the noise.
    Bad,
}

/// A name and what is said of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Definition {
    /// The name.
    pub label: String,
    /// What is said.
    pub text: String,
}

impl Definition {
    /// A name and what is said of it.
    pub fn new(label: impl Into<String>, text: impl Into<String>) -> Self {
        Self { label: label.into(), text: text.into() }
    }
}

/// A chart, drawn by [`crate::plot`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Figure {
    /// Its name within the section, as in the names of files; empty for the only one.
    pub name: String,
    /// The chart; empty where only the file is named.
    pub svg: String,
    /// The same for a narrow window, where it is laid out anew instead of being shrunk.
    pub narrow: Option<String>,
    /// Its panels one by one, for pages that put as many beside each other as there is room for; empty: the chart as it is.
    pub pieces: Vec<String>,
    /// The legend of the panels.
    pub legend: Option<String>,
    /// Width of one of them where there is room, px.
    pub piece_px: f64,
    /// The file of the chart beside the page, for media that only name it.
    pub file: Option<String>,
    /// What it shows.
    pub caption: String,
}

impl Figure {
    /// The only chart of a section.
    pub fn new(svg: String, caption: impl Into<String>) -> Self {
        Self {
            name: String::new(),
            svg,
            narrow: None,
            pieces: Vec::new(),
            legend: None,
            piece_px: 0.0,
            file: None,
            caption: caption.into(),
        }
    }

    /// The only chart of a section, drawn for a wide window and for a narrow one.
    pub fn laid_out([wide, narrow]: [String; 2], caption: impl Into<String>) -> Self {
        Self { narrow: Some(narrow), ..Self::new(wide, caption) }
    }

    /// The only chart of a section, with its panels one by one.
    ///
    /// # Errors
    /// As [`Panels::to_svg`].
    pub fn in_panels(panels: &Panels, caption: impl Into<String>) -> Result<Self, PlotError> {
        let (legend, pieces) = panels.pieces()?;
        Ok(Self { pieces, legend, piece_px: panels.panel_width(), ..Self::new(panels.to_svg()?, caption) })
    }

    /// The chart as one of several of a section.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// A chart in a file beside the page.
    pub fn in_file(file: impl Into<String>, caption: impl Into<String>) -> Self {
        Self { file: Some(file.into()), ..Self::new(String::new(), caption) }
    }
}

impl Block {
    /// Text.
    pub fn paragraph(text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into(), mood: None }
    }

    /// Text in color.
    pub fn colored(mood: Mood, text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into(), mood: Some(mood) }
    }

    /// Lines as they are.
    pub fn code(text: impl Into<String>) -> Self {
        Self::Code { text: text.into() }
    }

    /// Names with what is said of each.
    pub fn entries(entries: impl IntoIterator<Item = Definition>) -> Self {
        Self::Entries { number: None, entries: entries.into_iter().collect() }
    }

    /// One of several groups of entries.
    pub fn numbered(number: usize, entries: impl IntoIterator<Item = Definition>) -> Self {
        Self::Entries { number: Some(number), entries: entries.into_iter().collect() }
    }
}
