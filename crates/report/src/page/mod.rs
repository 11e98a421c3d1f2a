//! A page: its content, once for all media.
//!
//! A page consists of data and words without layout. [`crate::render`] shows it on a terminal, as Markdown and as HTML; the workbench
//! gets it as JSON. All media have the same content; a terminal omits details and says how many.

mod block;
mod table;
mod visible;

use serde::Serialize;

pub use block::{Block, Definition, Figure, Mood};
pub use table::{Cell, PageColumn, Table};

/// A page of sections.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Page {
    /// Its title.
    pub title: String,
    /// What it is about: machine, files, noise.
    pub subject: Vec<Definition>,
    /// From top to bottom.
    pub sections: Vec<Section>,
}

/// A titled part of a page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Section {
    /// Anchor within the page: lower-case letters and hyphens.
    pub id: String,
    /// Depth of its heading below the title: 1, or 2 within a section.
    pub depth: usize,
    /// Heading; empty for what stands right below the title.
    pub title: String,
    /// Small print beside the heading; may be empty.
    pub remark: String,
    /// Left out where there is little room.
    pub detail: bool,
    /// Closed until it is opened, where a page can be; open on paper.
    pub folded: bool,
    /// What it says.
    pub blocks: Vec<Block>,
}

impl Page {
    /// A page without sections.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// The page with one more line about its subject.
    #[must_use]
    pub fn about(mut self, label: impl Into<String>, text: impl Into<String>) -> Self {
        self.subject.push(Definition::new(label, text));
        self
    }

    /// The page with one section more, or none.
    #[must_use]
    pub fn with(mut self, section: impl Into<Option<Section>>) -> Self {
        self.sections.extend(section.into());
        self
    }

    /// The page with several sections more.
    #[must_use]
    pub fn with_all(mut self, sections: impl IntoIterator<Item = Section>) -> Self {
        self.sections.extend(sections);
        self
    }

    /// The page with these sections behind one of its own, or at the end.
    #[must_use]
    pub fn with_after(mut self, id: &str, sections: impl IntoIterator<Item = Section>) -> Self {
        let at = self.sections.iter().position(|s| s.id == id).map_or(self.sections.len(), |k| k + 1);
        self.sections.splice(at..at, sections);
        self
    }

    /// The section of an anchor.
    pub fn section_mut(&mut self, id: &str) -> Option<&mut Section> {
        self.sections.iter_mut().find(|s| s.id == id)
    }

    /// Every figure with its name: that of its section, and its own where the section has several.
    pub fn figures(&self) -> impl Iterator<Item = (String, &Figure)> {
        self.sections.iter().flat_map(|section| {
            section.blocks.iter().filter_map(|block| match block {
                Block::Figure(f) if f.name.is_empty() => Some((section.id.clone(), f)),
                Block::Figure(f) => Some((format!("{}-{}", section.id, f.name), f)),
                _ => None,
            })
        })
    }
}

impl Section {
    /// A section without blocks; its anchor is made from the title.
    pub fn new(title: impl Into<String>) -> Self {
        let title = title.into();
        Self {
            id: anchor(&title),
            depth: 1,
            title,
            remark: String::new(),
            detail: false,
            folded: false,
            blocks: Vec::new(),
        }
    }

    /// What stands right below the title of a page, without a heading.
    pub fn lead() -> Self {
        Self { id: "lead".to_owned(), ..Self::new("") }
    }

    /// The same section with another anchor.
    #[must_use]
    pub fn id(mut self, id: impl Into<String>) -> Self {
        self.id = id.into();
        self
    }

    /// The same section with small print beside the heading.
    #[must_use]
    pub fn remark(mut self, remark: impl Into<String>) -> Self {
        self.remark = remark.into();
        self
    }

    /// The same section as a part of the one before.
    #[must_use]
    pub fn within(mut self) -> Self {
        self.depth = 2;
        self
    }

    /// The same section, left out where there is little room.
    #[must_use]
    pub fn detail(mut self) -> Self {
        self.detail = true;
        self
    }

    /// The same section, closed until it is opened, where a page can be.
    #[must_use]
    pub fn folded(mut self) -> Self {
        self.folded = true;
        self
    }

    /// The section with one block more, or none.
    #[must_use]
    pub fn with(mut self, block: impl Into<Option<Block>>) -> Self {
        self.blocks.extend(block.into());
        self
    }

    /// The section with several blocks more.
    #[must_use]
    pub fn with_all(mut self, blocks: impl IntoIterator<Item = Block>) -> Self {
        self.blocks.extend(blocks);
        self
    }

    /// The section with a paragraph more.
    #[must_use]
    pub fn paragraph(self, text: impl Into<String>) -> Self {
        self.with(Block::paragraph(text))
    }

    /// The section with a list more; an empty one is left out.
    #[must_use]
    pub fn list<S: Into<String>>(self, items: impl IntoIterator<Item = S>) -> Self {
        let items: Vec<String> = items.into_iter().map(Into::into).collect();
        if items.is_empty() { self } else { self.with(Block::List { items }) }
    }

    /// The section with a table more.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.with(Block::Table(table))
    }

    /// The section with a chart more, which is in a file beside the page.
    #[must_use]
    pub fn figure(self, file: impl Into<String>, caption: impl Into<String>) -> Self {
        self.with(Block::Figure(Figure::in_file(file, caption)))
    }

    /// The section, or none unless it is wanted.
    pub fn when(self, wanted: bool) -> Option<Self> {
        wanted.then_some(self)
    }

    /// The section, or none when it says nothing.
    pub fn unless_empty(self) -> Option<Self> {
        (!self.blocks.is_empty()).then_some(self)
    }
}

/// Lower-case letters and digits, everything else as one hyphen.
fn anchor(title: &str) -> String {
    let kept = title.to_lowercase();
    let words: Vec<&str> = kept.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
    words.join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_named_by_their_section() {
        let chart = || "<svg></svg>".to_owned();
        let residuals = Section::new("Residuals")
            .with(Block::Figure(Figure::new(chart(), "").named("force")))
            .with(Block::Figure(Figure::new(chart(), "").named("length")));
        let machine = Section::new("The machine, drawn").with(Block::Figure(Figure::new(chart(), "")));
        let page = Page::default().with(residuals).with(machine);
        let names: Vec<String> = page.figures().map(|(name, _)| name).collect();
        assert_eq!(names, ["residuals-force", "residuals-length", "the-machine-drawn"]);
    }
}
