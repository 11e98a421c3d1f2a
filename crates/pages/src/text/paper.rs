//! A page of text at most 80 columns wide.

use super::Ink;

/// Columns of a page.
pub const WIDTH: usize = 80;

/// Collects headings, paragraphs and lines.
#[derive(Debug)]
pub struct Paper {
    text: String,
    ink: Ink,
}

impl Paper {
    /// An empty page.
    pub fn new(ink: Ink) -> Self {
        Self { text: String::new(), ink }
    }

    /// How words are painted on it.
    pub fn ink(&self) -> Ink {
        self.ink
    }

    /// What is on it.
    pub fn into_text(self) -> String {
        self.text
    }

    /// An empty line, then a heading and an explanation in small print.
    pub fn heading(&mut self, heading: &str, remark: &str) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
        let heading_width = heading.chars().count();
        let mut line = self.ink.strong(heading);
        let fits = heading_width + 2 + remark.chars().count() <= WIDTH;
        if fits && !remark.is_empty() {
            line.push_str("  ");
            line.push_str(&self.ink.faint(remark));
        }
        self.line(&line);
        if !fits {
            self.paragraph(2, remark);
        }
    }

    /// One line as it is; non-breaking blanks have done their work.
    pub fn line(&mut self, line: &str) {
        self.text.push_str(&line.trim_end().replace('\u{a0}', " "));
        self.text.push('\n');
    }

    /// Text wrapped to the width, every line indented.
    pub fn paragraph(&mut self, indent: usize, text: &str) {
        self.hanging(&" ".repeat(indent), indent, text);
    }

    /// `label`, then text wrapped beside it from column `indent` on.
    pub fn hanging(&mut self, label: &str, indent: usize, text: &str) {
        let label_width = label.chars().count();
        let mut start = format!("{label}{}", " ".repeat(indent.saturating_sub(label_width)));
        for line in wrap(text, WIDTH - indent) {
            let whole = format!("{start}{line}");
            self.line(&whole);
            start = " ".repeat(indent);
        }
    }
}

/// Lines of at most `width` characters; a longer word stands alone.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split([' ', '\n']).filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_wider_than_asked_unless_one_word_is() {
        let lines = wrap("the foundation yields under an unreasonablylongword of load", 12);
        assert_eq!(lines[0], "the");
        let wide: Vec<&String> = lines.iter().filter(|l| l.len() > 12).collect();
        assert_eq!(wide, ["unreasonablylongword"]);
    }

    #[test]
    fn a_label_stands_once_beside_its_text() {
        let mut paper = Paper::new(Ink::new(false));
        paper.hanging("  next", 8, &"word ".repeat(30));
        let text = paper.into_text();
        assert!(text.starts_with("  next  word word"));
        assert!(text.lines().skip(1).all(|l| l.starts_with("        word") && l.len() <= WIDTH));
    }
}
