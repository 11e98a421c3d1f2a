//! Few of many.

/// At most so many of `n` indices, one of each equal stretch. Where in its stretch an index lies wanders (by the golden ratio), so
/// that what alternates in a file, such as the approach, or returns at every pose, such as the loads, is not lost.
pub fn spread(n: usize, most: usize) -> impl Iterator<Item = usize> + Clone {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let count = n.min(most);
    let stretch = n as f64 / count.max(1) as f64;
    // Between 0 and n.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = move |k: usize| ((k as f64 + (k as f64 * GOLDEN).fract()) * stretch) as usize;
    (0..count).map(move |k| if n > most { index(k) } else { k })
}

/// At most so many of some things, spread alike.
pub fn spread_of<T: Copy>(all: impl AsRef<[T]>, most: usize) -> impl Iterator<Item = T> {
    spread(all.as_ref().len(), most).map(move |k| all.as_ref()[k])
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn thinning_keeps_what_alternates() {
        let kept: Vec<usize> = spread(1000, 100).collect();
        assert!(kept.is_sorted_by(|a, b| a < b) && kept.len() == 100 && kept[99] < 1000, "{kept:?}");
        for period in 2..=6 {
            for phase in 0..period {
                let found = kept.iter().filter(|i| *i % period == phase).count();
                let fair = 100 / period;
                assert!((fair / 2..=2 * fair).contains(&found), "{found} of 100 at {phase} of {period}");
            }
        }
    }

    #[test]
    fn few_are_all_kept() {
        assert!(spread(7, 100).eq(0..7));
        assert_eq!(spread(0, 100).count(), 0);
    }
}
