//! A page whose words can be shown where control characters act.

use hexbench_core::{visible, visible_lines};

use super::{Block, Cell, Definition, Page, Section, Table};

impl Page {
    /// The same page with every character visible that a terminal would obey, names of machines, files and sensors included.
    #[must_use]
    pub fn visible(&self) -> Self {
        let mut page = self.clone();
        line(&mut page.title);
        definitions(&mut page.subject);
        page.sections.iter_mut().for_each(section);
        page
    }
}

fn section(section: &mut Section) {
    line(&mut section.title);
    lines(&mut section.remark);
    for block in &mut section.blocks {
        match block {
            Block::Verdict { word, sentences, .. } => {
                line(word);
                sentences.iter_mut().for_each(lines);
            }
            Block::Paragraph { text, .. } | Block::Code { text } => lines(text),
            Block::List { items } => items.iter_mut().for_each(lines),
            Block::Entries { entries, .. } => definitions(entries),
            Block::Table(inner) => table(inner),
            Block::Figure(figure) => {
                lines(&mut figure.caption);
                figure.file.iter_mut().for_each(line);
            }
        }
    }
}

fn definitions(all: &mut [Definition]) {
    for definition in all {
        line(&mut definition.label);
        lines(&mut definition.text);
    }
}

fn table(table: &mut Table) {
    lines(&mut table.title);
    table.columns.iter_mut().for_each(|column| lines(&mut column.title));
    for cell in table.rows.iter_mut().flatten() {
        if let Cell::Text(text) = cell {
            lines(text);
        }
    }
}

fn line(text: &mut String) {
    *text = visible(text).into_owned();
}

fn lines(text: &mut String) {
    *text = visible_lines(text).into_owned();
}
