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

/// A bar of `share` of `width` columns, rounded, with a line in the column where it is `mark` long.
pub(super) fn bar(share: f64, mark: Option<f64>, width: usize) -> String {
    let has = |k: usize, share: f64| k as f64 + 0.5 <= share * width as f64;
    let marked = mark.and_then(|mark| (0..width).rfind(|&k| has(k, mark)));
    let column = |k: usize| match (marked == Some(k), has(k, share)) {
        (true, _) => '|',
        (false, true) => '#',
        (false, false) => ' ',
    };
    (0..width).map(column).collect::<String>().trim_end().to_owned()
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
        assert_eq!(bar(0.5, None, 10), "#####");
        assert_eq!(bar(0.0, None, 10), "");
        assert_eq!(bar(7.0, None, 3), "###");
        assert_eq!(bar(f64::NAN, None, 3), "");
    }

    #[test]
    fn a_line_crosses_a_bar_where_it_would_end_there() {
        assert_eq!(bar(0.8, Some(0.5), 10), "####|###");
        assert_eq!(bar(0.2, Some(0.5), 10), "##  |");
        assert_eq!(bar(1.0, Some(1.0), 4), "###|");
        assert_eq!(bar(0.5, Some(0.001), 4), "##", "a line at nothing is none");
    }
}
