//! Changes that keep what a reader sees first: lines, cells, keys and numbers.
//!
//! A bit that flips in a table is mostly a number that is no number. A column that is gone, a row that is there twice, an exponent of
//! 308 or a bracket opened two hundred times reach further.

use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Numbers at the edges of what readers, units and physics take, and words that are numbers to some.
const NUMBERS: [&str; 30] = [
    "0",
    "-0",
    "1",
    "-1",
    "1e-320",
    "1e-300",
    "1e-30",
    "1e-12",
    "-1e-12",
    "0.5",
    "1e3",
    "1e6",
    "1e12",
    "1e29",
    "1e30",
    "-1e30",
    "1e31",
    "1e300",
    "1e308",
    "-1e308",
    "1e309",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "9007199254740993",
    "18446744073709551616",
    "1,5",
    "0x10",
    "1_000",
];

/// Bytes and characters that end, open or hide something.
const MARKS: [&str; 24] = [
    "\0",
    "\r",
    "\n",
    "\r\n",
    "\t",
    ",",
    ";",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "=",
    "#",
    ".",
    "-",
    "\u{feff}",
    "\u{202e}",
    "\u{1b}[31m",
    "\u{e4}",
    "\"\"\"",
    "[[",
    "_",
];

/// How often a bracket is opened to see how deep a parser follows.
const DEEP: usize = 200;

/// One to four changes of some bytes; equal seeds make equal changes.
pub fn mutate(data: &[u8], seed: u64) -> Vec<u8> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut bytes = data.to_vec();
    for _ in 0..rng.random_range(1..=4) {
        change(&mut bytes, &mut rng);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, rng: &mut Pcg64) {
    match rng.random_range(0..10) {
        0..=3 => token(bytes, rng),
        4 | 5 => pieces(bytes, b"\n", rng),
        6 | 7 => pieces(bytes, b",;\t:", rng),
        8 => mark(bytes, rng),
        _ => raw(bytes, rng),
    }
}

/// A number becomes another, a word another word of the same text.
fn token(bytes: &mut Vec<u8>, rng: &mut Pcg64) {
    let spans = spans(bytes, |b| b.is_ascii_alphanumeric() || b"+-._".contains(&b));
    let Some(&(start, end)) = spans.choose(rng) else { return };
    let is_number = std::str::from_utf8(&bytes[start..end]).is_ok_and(|text| text.parse::<f64>().is_ok());
    let new = if is_number && rng.random_bool(0.9) {
        NUMBERS.choose(rng).map_or(Vec::new(), |number| number.as_bytes().to_vec())
    } else {
        spans.choose(rng).map_or(Vec::new(), |&(from, to)| bytes[from..to].to_vec())
    };
    bytes.splice(start..end, new);
}

/// A line or a cell is left out, doubled, or changes place with another.
fn pieces(bytes: &mut Vec<u8>, separators: &[u8], rng: &mut Pcg64) {
    let spans = spans(bytes, |b| !separators.contains(&b));
    let (Some(&one), Some(&other)) = (spans.choose(rng), spans.choose(rng)) else { return };
    let [first, second] = if one <= other { [one, other] } else { [other, one] };
    match rng.random_range(0..4) {
        0 => drop(bytes.drain(one.0..(one.1 + 1).min(bytes.len()))),
        1 => {
            let again = [&bytes[one.0..one.1], separators.get(..1).unwrap_or_default()].concat();
            bytes.splice(other.0..other.0, again);
        }
        2 if first != second => {
            let exchanged =
                [&bytes[second.0..second.1], &bytes[first.1..second.0], &bytes[first.0..first.1]].concat();
            bytes.splice(first.0..second.1, exchanged);
        }
        _ => bytes.truncate(one.1),
    }
}

fn mark(bytes: &mut Vec<u8>, rng: &mut Pcg64) {
    let place = rng.random_range(0..=bytes.len());
    let Some(mark) = MARKS.choose(rng) else { return };
    let times = if rng.random_bool(0.05) { DEEP } else { 1 };
    bytes.splice(place..place, mark.repeat(times).into_bytes());
}

fn raw(bytes: &mut Vec<u8>, rng: &mut Pcg64) {
    if bytes.is_empty() {
        bytes.push(rng.random());
        return;
    }
    let place = rng.random_range(0..bytes.len());
    match rng.random_range(0..4) {
        0 => bytes[place] ^= 1 << rng.random_range(0..8),
        1 => bytes[place] = rng.random(),
        2 => drop(bytes.remove(place)),
        _ => bytes.insert(place, rng.random()),
    }
}

/// Longest runs of bytes that belong to a piece: `[start, end)`.
fn spans(bytes: &[u8], belongs: impl Fn(u8) -> bool) -> Vec<(usize, usize)> {
    let mut spans = Vec::new();
    let mut start = None;
    for (at, &byte) in bytes.iter().chain([&0]).enumerate() {
        match (start, at < bytes.len() && belongs(byte)) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                spans.push((from, at));
                start = None;
            }
            _ => {}
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[u8] = b"a_mm,b_mm\n1,2\n3,4\n";

    #[test]
    fn equal_seeds_make_equal_changes_and_different_seeds_make_many() {
        let all: std::collections::BTreeSet<_> = (0..500).map(|seed| mutate(TABLE, seed)).collect();
        assert!(all.len() > 400, "{}", all.len());
        assert_eq!(mutate(TABLE, 7), mutate(TABLE, 7));
    }

    #[test]
    fn anything_can_be_changed_the_empty_file_too() {
        for seed in 0..500 {
            mutate(b"", seed);
            mutate(&[0xff, b'\n', 0xfe], seed);
        }
    }

    #[test]
    fn spans_are_the_runs_between_separators() {
        assert_eq!(spans(b"ab,c,,d", |b| b != b','), [(0, 2), (3, 4), (6, 7)]);
    }
}
