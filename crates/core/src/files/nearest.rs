//! The name that was probably meant.

/// The known name nearest to `word`, when it is near enough to be a slip of the pen: one edit for names of three to
/// five letters, two for longer ones. Two swapped neighbours count as one edit; case does not count.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let scored = known.into_iter().map(|name| (edit_distance(&word, &name.to_lowercase()), name));
    let (distance, name) = scored.min_by_key(|(distance, _)| *distance)?;
    (distance <= allowed_edits(word.len().max(name.len()))).then_some(name)
}

fn allowed_edits(length: usize) -> usize {
    match length {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    }
}

/// Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let substituted = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substituted.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted() {
        let table =
            [("", "abc", 3), ("dalpha", "dalpha", 0), ("dapha", "dalpha", 1), ("dlapha", "dalpha", 1)];
        for (a, b, expected) in table {
            assert_eq!(edit_distance(a, b), expected, "{a} -> {b}");
        }
    }

    #[test]
    fn a_slip_is_near_and_another_word_is_not() {
        let known = ["a", "fx", "alpha", "elapsed"];
        assert_eq!(nearest("alfa", known), None);
        assert_eq!(nearest("alpa", known), Some("alpha"));
        assert_eq!(nearest("Elapst", known), Some("elapsed"));
        assert_eq!(nearest("x", known), None);
        assert_eq!(nearest("humidity", known), None);
    }
}
