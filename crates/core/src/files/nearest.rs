//! The name that was probably meant.

use strsim::osa_distance;

/// The known name nearest to `word`, when it is near enough to be a slip of the pen: one edit for names of three to
/// five letters, two for longer ones. Two swapped neighbors count as one edit; case does not count.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let scored = known.into_iter().map(|name| (osa_distance(&word, &name.to_lowercase()), name));
    let (distance, name) = scored.min_by_key(|(distance, _)| *distance)?;
    (distance <= allowed_edits(word.len().max(name.len()))).then_some(name)
}

/// What to write instead of a word that is none of these names, one sentence.
pub fn instead_of(word: &str, names: &[&str]) -> String {
    match nearest(word, names.iter().copied()) {
        Some(near) => format!("Write \"{near}\"."),
        None => format!("Write one of {}.", names.join(", ")),
    }
}

fn allowed_edits(length: usize) -> usize {
    match length {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_near_and_another_word_is_not() {
        let known = ["a", "fx", "alpha", "elapsed"];
        assert_eq!(nearest("alfa", known), None);
        assert_eq!(nearest("alpa", known), Some("alpha"));
        assert_eq!(nearest("Elapst", known), Some("elapsed"));
        assert_eq!(nearest("x", known), None);
        assert_eq!(nearest("humidity", known), None);
        // Two neighbors swapped: one edit.
        assert_eq!(nearest("aplha", known), Some("alpha"));
    }
}
