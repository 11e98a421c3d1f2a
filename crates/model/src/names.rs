//! The name that was probably meant.

/// The known name with the fewest edits from `word`, when at most a third of its letters differ.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let scored = known.into_iter().map(|name| (edits(word, name), name));
    let (distance, name) = scored.min_by_key(|(distance, _)| *distance)?;
    (3 * distance <= word.chars().count().max(3)).then_some(name)
}

/// Insertions, deletions and substitutions between two words (Levenshtein distance).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut row = vec![i + 1];
        for (j, other) in b.iter().enumerate() {
            let substituted = last[j] + usize::from(letter != *other);
            row.push(substituted.min(last[j + 1] + 1).min(row[j] + 1));
        }
        last = row;
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_is_recognised_and_another_word_is_not() {
        let known = ["base-compliance", "leg-coupling", "creep"];
        assert_eq!(nearest("base-complaince", known), Some("base-compliance"));
        assert_eq!(nearest("crep", known), Some("creep"));
        assert_eq!(nearest("humidity", known), None);
    }
}
