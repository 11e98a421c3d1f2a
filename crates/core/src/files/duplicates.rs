//! Rows that are copies of earlier rows.

use super::warning::Notice;
use super::{FilePlace, Warning};
use crate::Observation;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Fingerprints of the rows read so far, instead of the rows themselves.
#[derive(Debug, Default)]
pub(crate) struct Fingerprints(Vec<(u64, usize)>);

impl Fingerprints {
    /// Notes the next row: its text, or all its cells.
    pub(crate) fn note(&mut self, row: &(impl Hash + ?Sized)) {
        let mut hasher = DefaultHasher::new();
        row.hash(&mut hasher);
        self.0.push((hasher.finish(), self.0.len()));
    }

    /// Indices `[first, copy]` of rows with the same text and the same numbers. The numbers are compared too, so
    /// that two rows that merely share a fingerprint are both kept.
    fn copies(mut self, same: impl Fn(usize, usize) -> bool) -> Vec<[usize; 2]> {
        self.0.sort_unstable();
        let groups = self.0.chunk_by(|one, other| one.0 == other.0);
        let pairs = groups.flat_map(|group| group[1..].iter().map(|copy| [group[0].1, copy.1]));
        let mut copies: Vec<_> = pairs.filter(|[first, copy]| same(*first, *copy)).collect();
        copies.sort_unstable_by_key(|[_, copy]| *copy);
        copies
    }
}

/// Removes the copies and says which lines they were. `has_pose`: pose numbers come from the file.
pub(crate) fn drop_copies(
    observations: &mut Vec<Observation>,
    fingerprints: Fingerprints,
    has_pose: bool,
) -> Option<Warning> {
    let numbers = |i: usize| {
        let row: Observation = observations[i];
        Observation { line: 0, pose_id: if has_pose { row.pose_id } else { 0 }, ..row }
    };
    let copies = fingerprints.copies(|one, other| numbers(one) == numbers(other));
    let last = copies.last()?[1];
    let mut lines = copies.iter().map(|pair| pair.map(|i| observations[i].line)).collect::<Vec<_>>();
    lines.dedup();
    let mut is_copy = vec![false; last + 1];
    for [_, copy] in &copies {
        is_copy[*copy] = true;
    }
    let mut index = 0..;
    observations.retain(|_| index.next().is_none_or(|i: usize| !is_copy.get(i).copied().unwrap_or(false)));
    let place = FilePlace { line: lines.first().map(|[_, copy]| *copy), ..FilePlace::file() };
    Some(Warning::new(place, Notice::IdenticalRows { lines }))
}
