//! A page of headings, paragraphs, lists, tables and figures, as Markdown or as plain text of 80 columns.

/// Columns of plain text.
const WIDTH: usize = 80;

/// A page, built from top to bottom.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Document {
    blocks: Vec<Block>,
}

#[derive(Debug, Clone, PartialEq)]
enum Block {
    Heading { level: usize, text: String },
    Paragraph(String),
    List(Vec<String>),
    Table { header: Vec<String>, rows: Vec<Vec<String>> },
    Figure { file: String, caption: String },
}

impl Document {
    /// Adds a heading; level 1 is the title.
    pub fn heading(&mut self, level: usize, text: impl Into<String>) {
        self.blocks.push(Block::Heading { level, text: text.into() });
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Paragraph(text.into()));
    }

    /// Adds a list.
    pub fn list<S: Into<String>>(&mut self, items: impl IntoIterator<Item = S>) {
        self.blocks.push(Block::List(items.into_iter().map(Into::into).collect()));
    }

    /// Adds a table; the first column is set left, the others right.
    pub fn table<S: Into<String>>(
        &mut self,
        header: impl IntoIterator<Item = S>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) {
        let header = header.into_iter().map(Into::into).collect();
        self.blocks.push(Block::Table { header, rows: rows.into_iter().collect() });
    }

    /// Adds a picture from a file beside the page.
    pub fn figure(&mut self, file: impl Into<String>, caption: impl Into<String>) {
        self.blocks.push(Block::Figure { file: file.into(), caption: caption.into() });
    }

    /// The page as Markdown.
    pub fn to_markdown(&self) -> String {
        self.joined(markdown)
    }

    /// The page as text of at most 80 columns (tables as wide as they are); figures by their file names.
    pub fn to_text(&self) -> String {
        self.joined(plain)
    }

    fn joined(&self, render: fn(&Block) -> String) -> String {
        let blocks: Vec<String> = self.blocks.iter().map(render).collect();
        blocks.join("\n\n") + "\n"
    }
}

fn markdown(block: &Block) -> String {
    match block {
        Block::Heading { level, text } => format!("{} {text}", "#".repeat(*level)),
        Block::Paragraph(text) => wrapped("", "", text),
        Block::List(items) => each(items, |item| wrapped("- ", "  ", item)),
        Block::Table { header, rows } => markdown_table(header, rows),
        Block::Figure { file, caption } => format!("![{caption}]({file})"),
    }
}

fn plain(block: &Block) -> String {
    match block {
        Block::Heading { level: 1, text } => format!("{text}\n{}", "=".repeat(text.chars().count())),
        Block::Heading { text, .. } => format!("{text}\n{}", "-".repeat(text.chars().count())),
        Block::Paragraph(text) => wrapped("", "", text),
        Block::List(items) => each(items, |item| wrapped("- ", "  ", item)),
        Block::Table { header, rows } => {
            let widths = widths(header, rows);
            let lines = std::iter::once(header).chain(rows);
            let lines: Vec<String> = lines.map(|row| aligned(row, &widths).join("  ")).collect();
            lines.iter().map(|l| format!("  {}", l.trim_end())).collect::<Vec<_>>().join("\n")
        }
        Block::Figure { file, caption } => wrapped("", "", &format!("[{file}] {caption}")),
    }
}

fn each(items: &[String], render: impl Fn(&String) -> String) -> String {
    items.iter().map(render).collect::<Vec<_>>().join("\n")
}

fn markdown_table(header: &[String], rows: &[Vec<String>]) -> String {
    let widths = widths(header, rows);
    let line = |row: &[String]| format!("| {} |", aligned(row, &widths).join(" | "));
    let rule = widths.iter().enumerate().map(|(k, w)| {
        let dashes = "-".repeat((*w).max(3) - 1);
        if k == 0 { format!("{dashes}-") } else { format!("{dashes}:") }
    });
    let rule = format!("| {} |", rule.collect::<Vec<_>>().join(" | "));
    let lines = [line(header), rule].into_iter().chain(rows.iter().map(|r| line(r)));
    lines.collect::<Vec<_>>().join("\n")
}

fn widths(header: &[String], rows: &[Vec<String>]) -> Vec<usize> {
    const NARROWEST: usize = 3;
    let width = |k: usize| {
        let cells = std::iter::once(header).chain(rows.iter().map(Vec::as_slice)).filter_map(|r| r.get(k));
        cells.map(|c| c.chars().count()).max().unwrap_or(0).max(NARROWEST)
    };
    (0..header.len()).map(width).collect()
}

/// Cells filled with blanks to their widths; missing ones are empty.
fn aligned(row: &[String], widths: &[usize]) -> Vec<String> {
    let cell = |(k, width): (usize, &usize)| {
        let text = row.get(k).map_or("", String::as_str);
        let gap = " ".repeat(width.saturating_sub(text.chars().count()));
        if k == 0 { format!("{text}{gap}") } else { format!("{gap}{text}") }
    };
    widths.iter().enumerate().map(cell).collect()
}

/// Text wrapped to the width, the first line after `first`, the others after `rest`.
fn wrapped(first: &str, rest: &str, text: &str) -> String {
    let mut lines: Vec<String> = vec![first.to_owned()];
    let mut fresh = true;
    for word in text.split_whitespace() {
        let line = lines.len() - 1;
        let fits = lines[line].chars().count() + 1 + word.chars().count() <= WIDTH;
        if fresh {
            lines[line].push_str(word);
        } else if fits {
            lines[line].push(' ');
            lines[line].push_str(word);
        } else {
            lines.push(format!("{rest}{word}"));
        }
        fresh = false;
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page() -> Document {
        let mut page = Document::default();
        page.heading(1, "Title");
        page.paragraph("word ".repeat(40));
        page.list(["one", "two"]);
        page.table(["leg", "k"], [vec!["1".to_owned(), "4.20".to_owned()]]);
        page.figure("a.svg", "A curve");
        page
    }

    #[test]
    fn a_page_is_markdown_and_text() {
        let markdown = page().to_markdown();
        assert!(markdown.starts_with("# Title\n\nword word"));
        assert!(markdown.contains("- one\n- two\n\n| leg |    k |\n| --- | ---: |\n| 1   | 4.20 |"));
        assert!(markdown.ends_with("![A curve](a.svg)\n"));
        assert!(page().to_text().contains("  leg     k\n  1    4.20"));
    }

    #[test]
    fn no_line_of_text_is_wider_than_the_page() {
        assert!(page().to_text().lines().all(|l| l.chars().count() <= WIDTH));
    }
}
