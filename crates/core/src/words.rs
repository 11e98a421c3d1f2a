//! Pieces of sentences: lists, first letters, numbers with the digits that matter.

/// `a, b and c`.
pub fn joined<S: AsRef<str>>(words: &[S]) -> String {
    joined_with(words, "and")
}

/// `a, b or c`.
pub fn joined_with<S: AsRef<str>>(words: &[S], last_joint: &str) -> String {
    match words {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [head @ .., last] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} {last_joint} {}", head.join(", "), last.as_ref())
        }
    }
}

/// The same text with a small first letter.
pub fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_lowercase().chain(letters).collect()).unwrap_or_default()
}

/// The same text with a capital first letter.
pub fn upper_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// A number with so many significant digits.
pub fn to_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!(joined(&["a"]), "a");
        assert_eq!(joined_with(&["a", "b", "c"], "or"), "a, b or c");
    }
}
