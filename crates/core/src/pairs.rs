//! Pairs of six things.

/// Every two of six legs or coordinates, from zero: the places above the diagonal of a 6x6 matrix, row by row.
pub fn pairs_of_six() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)))
}
