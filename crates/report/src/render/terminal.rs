//! A page for a terminal: text of 80 columns.

use crate::page::{Block, Definition, Page, Section, Table};

use super::TextStyle;
use super::grid::Grid;
use super::layout::{WIDTH, length, padded, wrapped};

/// How a page is shown on a terminal.
#[derive(Debug, Clone, Copy, Default)]
pub struct Terminal {
    /// Words in color.
    pub style: TextStyle,
    /// Every row and column, detail included.
    pub verbose: bool,
}

/// The page as text.
pub fn terminal(page: &Page, with: Terminal) -> String {
    let page = &page.visible();
    let mut out = Writer { text: String::new(), with };
    if !page.title.is_empty() {
        out.heading(&page.title, "");
    }
    out.entries(None, &page.subject, label_width([(None, page.subject.as_slice())]));
    page.sections.iter().filter(|s| with.verbose || !s.detail).for_each(|section| out.section(section));
    out.text
}

/// The page as text without color, details left out.
pub fn plain(page: &Page) -> String {
    terminal(page, Terminal::default())
}

struct Writer {
    text: String,
    with: Terminal,
}

impl Writer {
    fn section(&mut self, section: &Section) {
        self.heading(&section.title, &section.remark);
        let groups = section.blocks.iter().filter_map(|block| match block {
            Block::Entries { number, entries } => Some((*number, entries.as_slice())),
            _ => None,
        });
        let indent = label_width(groups);
        let mut above: Option<&Block> = None;
        for block in &section.blocks {
            if matches!((above, block), (Some(Block::Table(_)), Block::Table(t)) if t.title.is_empty()) {
                self.line("");
            }
            self.block(block, indent);
            above = Some(block);
        }
    }

    fn block(&mut self, block: &Block, indent: usize) {
        let style = self.with.style;
        match block {
            Block::Verdict { word, mood, sentences } => {
                self.line(&format!("  {}", style.mood(Some(*mood), word)));
                for sentence in sentences {
                    self.hanging("", 2, sentence);
                }
            }
            Block::Paragraph { text, mood } => {
                for line in wrapped(text, WIDTH - 2) {
                    self.line(&format!("  {}", style.mood(*mood, &line)));
                }
            }
            Block::List { items } => items.iter().for_each(|item| self.hanging("  -", 4, item)),
            Block::Entries { number, entries } => self.entries(*number, entries, indent),
            Block::Code { text } => text.lines().for_each(|line| self.line(&format!("  {line}"))),
            Block::Table(table) => self.table(table),
            Block::Figure(figure) => {
                if let Some(file) = &figure.file {
                    self.hanging("", 2, &format!("[{file}] {}", figure.caption));
                }
            }
        }
    }

    /// An empty line, then a heading with small print beside it, or below where it does not fit.
    fn heading(&mut self, heading: &str, remark: &str) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
        if heading.is_empty() {
            return;
        }
        let style = self.with.style;
        let mut line = style.strong(heading);
        let fits = length(heading) + 2 + length(remark) <= WIDTH;
        if fits && !remark.is_empty() {
            line = format!("{line}  {}", style.faint(remark));
        }
        self.line(&line);
        if !fits {
            self.hanging("", 2, remark);
        }
    }

    /// One line as it is; non-breaking blanks have done their work.
    fn line(&mut self, line: &str) {
        self.text.push_str(&line.trim_end().replace('\u{a0}', " "));
        self.text.push('\n');
    }

    /// `label`, then text wrapped beside it from column `indent` on.
    fn hanging(&mut self, label: &str, indent: usize, text: &str) {
        let mut start = padded(label, indent, true);
        for line in wrapped(text, WIDTH - indent) {
            self.line(&format!("{start}{line}"));
            start = " ".repeat(indent);
        }
    }

    fn entries(&mut self, number: Option<usize>, entries: &[Definition], indent: usize) {
        for (k, entry) in entries.iter().enumerate() {
            let mark = match number {
                Some(number) if k == 0 => format!("  {number:<2} "),
                Some(_) => " ".repeat(NUMBERED),
                None => " ".repeat(PLAIN),
            };
            self.hanging(&format!("{mark}{}", entry.label), indent, &entry.text);
        }
    }

    fn table(&mut self, table: &Table) {
        let mut indent = 2;
        if !table.title.is_empty() {
            self.hanging("", indent, &table.title);
            indent += 2;
        }
        let shown = match table.brief {
            Some(brief) if !self.with.verbose => brief.min(table.rows.len()),
            _ => table.rows.len(),
        };
        let blanks = " ".repeat(indent);
        if shown > 0 {
            let Terminal { style, verbose } = self.with;
            let lines = Grid::lines(table, shown, verbose, WIDTH - indent, style);
            for line in lines {
                self.line(&format!("{blanks}{line}"));
            }
        }
        match table.rows.len() - shown {
            0 => {}
            more if shown == 0 => self.line(&format!("{blanks}One by one, {more} rows: --verbose")),
            more => self.line(&format!("{blanks}and {more} more (--verbose)")),
        }
    }
}

/// Columns before the label of an entry, and of one in a numbered group.
const PLAIN: usize = 2;
const NUMBERED: usize = 5;

/// Column at which the texts of some groups of entries begin.
fn label_width<'a>(groups: impl IntoIterator<Item = (Option<usize>, &'a [Definition])>) -> usize {
    /// A longer label leaves its text no room.
    const WIDEST: usize = 34;
    let width = |(number, entries): (Option<usize>, &[Definition])| {
        let longest = entries.iter().map(|e| length(&e.label)).max().unwrap_or(0);
        longest + 2 + if number.is_some() { NUMBERED } else { PLAIN }
    };
    groups.into_iter().map(width).max().unwrap_or(0).min(WIDEST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::PageColumn;

    fn shown(section: Section, verbose: bool) -> String {
        terminal(&Page::default().with(section), Terminal { verbose, ..Terminal::default() })
    }

    #[test]
    fn a_label_stands_once_beside_its_text() {
        let entry = Definition::new("next", "word ".repeat(30));
        let text = shown(Section::new("Head").with(Block::entries([entry])), false);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(&lines[1][..17], "  next  word word");
        assert!(lines[2..].iter().all(|l| l.starts_with("        word") && l.len() <= WIDTH));
    }

    #[test]
    fn numbers_stand_right_and_words_left() {
        let table = Table::named(["leg", "k"]).rows([["1", "4.2"], ["total", "14.25"]]);
        assert_eq!(
            shown(Section::new("Legs").table(table), false),
            "Legs\n  leg        k\n  1        4.2\n  total  14.25\n"
        );
    }

    #[test]
    fn detail_is_counted_not_lost() {
        let columns = [PageColumn::words("a"), PageColumn::number("b").detail()];
        let table = Table::new(columns).rows([["x", "1"], ["y", "2"], ["z", "3"]]).brief(1);
        assert_eq!(
            shown(Section::new("T").table(table.clone()), false),
            "T\n  a\n  x\n  and 2 more (--verbose)\n"
        );
        assert_eq!(shown(Section::new("T").table(table), true), "T\n  a  b\n  x  1\n  y  2\n  z  3\n");
    }

    #[test]
    fn a_wide_last_column_of_words_is_wrapped() {
        let table = Table::new([PageColumn::words("id"), PageColumn::words("text")])
            .rows([["one", &"word ".repeat(40)]]);
        let text = shown(Section::new("T").table(table), false);
        assert!(text.lines().count() > 3 && text.lines().all(|l| length(l) <= WIDTH), "{text}");
    }
}
