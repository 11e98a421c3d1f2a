//! Text of a stranger, fit for a terminal.

use std::borrow::Cow;

/// A text in one line without anything that acts instead of being seen: control characters, which a terminal obeys, and characters that
/// turn the direction of writing stand as `\u{1b}`.
///
/// Source of the list: Unicode Standard Annex 9, table 4 and section 2; general category Cc, Zl and Zp.
///
/// # Example
/// ```
/// assert_eq!(hexbench_core::visible("a\u{1b}[31mb"), "a\\u{1b}[31mb");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, acts)
}

/// The same of a text of several lines.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |letter| letter != '\n' && acts(letter))
}

/// The same of JSON, which stays JSON and means the same: only texts of it can hold such letters, and there they may be written so.
pub fn visible_json(text: &str) -> Cow<'_, str> {
    let hidden = |letter| letter != '\n' && acts(letter);
    if !text.contains(hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if hidden(letter) {
            // All of them are in the basic plane.
            let code = format!("\\u{:04x}", u32::from(letter));
            shown.push_str(&code);
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

fn escaped(text: &str, acts: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&acts) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if acts(letter) { shown.extend(letter.escape_unicode()) } else { shown.push(letter) }
    }
    Cow::Owned(shown)
}

fn acts(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_stays_json_and_means_the_same() {
        let text = "\"a\u{9b}b\u{202e}c\"";
        assert_eq!(visible_json(text), r#""a\u009bb\u202ec""#);
        assert_eq!(visible_json("{\n}"), "{\n}");
    }

    #[test]
    fn what_acts_is_seen_and_all_else_is_as_it_was() {
        assert_eq!(visible("\u{1b}]0;x\u{7}\u{9b}1m\u{202e}\n"), "\\u{1b}]0;x\\u{7}\\u{9b}1m\\u{202e}\\u{a}");
        assert_eq!(visible_lines("a\nb\r"), "a\nb\\u{d}");
        assert!(matches!(visible("5 \u{b5}m, \u{65e5}\u{672c}, 1\u{a0}mm"), Cow::Borrowed(_)));
    }
}
