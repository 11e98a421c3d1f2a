//! Declarations of types with one field a line.

/// Columns of one level.
const INDENT: &str = "  ";

/// Breaks a declaration into lines: braces open a level, commas within braces end a line, comments stand above what they tell of.
pub(super) fn laid_out(declaration: &str) -> String {
    let mut page = Layout { text: "\n".to_owned(), open: Vec::new() };
    let mut rest = declaration.trim();
    while let Some(next) = rest.chars().next() {
        let length = match next {
            '/' => rest.find("*/").map_or(rest.len(), |end| end + 2),
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            _ => next.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        page.take(next, token);
        rest = after;
    }
    page.text.push('\n');
    page.text
}

struct Layout {
    text: String,
    /// Brackets that are open.
    open: Vec<char>,
}

impl Layout {
    fn take(&mut self, kind: char, token: &str) {
        match kind {
            '/' => self.comment(token),
            '{' => {
                self.put(token);
                self.open.push(kind);
                self.text.push('\n');
            }
            '[' | '<' => {
                self.put(token);
                self.open.push(kind);
            }
            '}' => {
                self.open.pop();
                self.break_line();
                self.put(token);
            }
            ']' | '>' => {
                self.open.pop();
                self.put(token);
            }
            ',' if self.open.last() == Some(&'{') => self.text.push_str(";\n"),
            _ if kind.is_whitespace() => self.space(),
            _ => self.put(token),
        }
    }

    /// Text at its place; the first of a line is indented.
    fn put(&mut self, token: &str) {
        if self.text.ends_with('\n') {
            self.text += &INDENT.repeat(self.open.len());
        }
        self.text += token;
    }

    /// Spaces do not begin a line and stand alone.
    fn space(&mut self) {
        if !self.text.ends_with([' ', '\n']) {
            self.text.push(' ');
        }
    }

    fn break_line(&mut self) {
        if !self.text.ends_with('\n') {
            self.text.truncate(self.text.trim_end().len());
            self.text.push('\n');
        }
    }

    /// A comment of one line stays on one.
    fn comment(&mut self, token: &str) {
        self.break_line();
        let inner = token.trim_start_matches("/**").trim_end_matches("*/");
        let inner = inner.replace("[`", "`").replace("`]", "`");
        let lines: Vec<&str> = inner
            .lines()
            .map(|l| l.trim().trim_start_matches('*').trim())
            .filter(|l| !l.is_empty())
            .collect();
        if let [line] = lines[..] {
            self.put(&format!("/** {line} */\n"));
            return;
        }
        self.put("/**\n");
        for line in lines {
            self.put(&format!(" * {line}\n"));
        }
        self.put(" */\n");
    }
}

#[test]
fn fields_and_comments_have_lines_of_their_own() {
    let declaration = "/**\n * A word.\n */\nexport type Kind = { \"from\": \"a, b\", \n/**\n * See [`Other`],\n * twice.\n */\nrow: \
                       Array<[number, string]>, } | { \"from\": \"none\", };";
    let expected = "
/** A word. */
export type Kind = {
  \"from\": \"a, b\";
  /**
   * See `Other`,
   * twice.
   */
  row: Array<[number, string]>;
} | {
  \"from\": \"none\";
};
";
    assert_eq!(laid_out(declaration), expected);
}
