//! Writing a page from top to bottom.

use super::{Block, Figure, Page, Section, Table};

impl Page {
    /// The title at level 1, else the heading of a new section; level 3 stands within the section before.
    pub fn heading(&mut self, level: usize, text: impl Into<String>) {
        match level {
            1 => self.title = text.into(),
            2 => self.sections.push(Section::new(text)),
            _ => self.sections.push(Section::new(text).within()),
        }
    }

    /// One block more in the last section.
    pub fn push(&mut self, block: Block) {
        if self.sections.is_empty() {
            self.sections.push(Section::lead());
        }
        if let Some(last) = self.sections.last_mut() {
            last.blocks.push(block);
        }
    }

    /// A paragraph in the last section.
    pub fn paragraph(&mut self, text: impl Into<String>) {
        self.push(Block::paragraph(text));
    }

    /// A list in the last section.
    pub fn list<S: Into<String>>(&mut self, items: impl IntoIterator<Item = S>) {
        self.push(Block::List { items: items.into_iter().map(Into::into).collect() });
    }

    /// A table in the last section: names in the first column, numbers in the others.
    pub fn table<S: Into<String>>(
        &mut self,
        header: impl IntoIterator<Item = S>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) {
        self.push(Block::Table(Table::named(header).rows(rows)));
    }

    /// A chart in a file beside the page, in the last section.
    pub fn figure(&mut self, file: impl Into<String>, caption: impl Into<String>) {
        self.push(Block::Figure(Figure::in_file(file, caption)));
    }
}
