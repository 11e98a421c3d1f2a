//! Wrapped text and aligned columns, for media of fixed width.

/// Columns of a page.
pub const WIDTH: usize = 80;

/// Lines of at most `width` characters; a longer word stands alone. A non-breaking blank holds words together.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split([' ', '\n']).filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if length(line) + 1 + length(word) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Characters of a text.
pub(super) fn length(text: &str) -> usize {
    text.chars().count()
}

/// A text filled with blanks to a width.
pub(super) fn padded(text: &str, width: usize, left: bool) -> String {
    let gap = " ".repeat(width.saturating_sub(length(text)));
    if left { format!("{text}{gap}") } else { format!("{gap}{text}") }
}

/// A bar of `share` of `width` columns, rounded.
pub(super) fn bar(share: f64, width: usize) -> String {
    let long = share * width as f64;
    (0..width).take_while(|k| *k as f64 + 0.5 <= long).map(|_| '#').collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_wider_than_asked_unless_one_word_is() {
        let lines = wrapped("the foundation yields under an unreasonablylongword of load", 12);
        assert_eq!(lines[0], "the");
        let wide: Vec<&String> = lines.iter().filter(|l| l.len() > 12).collect();
        assert_eq!(wide, ["unreasonablylongword"]);
    }

    #[test]
    fn a_bar_is_as_long_as_its_share() {
        assert_eq!(bar(0.5, 10), "#####");
        assert_eq!(bar(0.0, 10), "");
        assert_eq!(bar(7.0, 3), "###");
        assert_eq!(bar(f64::NAN, 3), "");
    }
}
