//! Lines of a file of measurements, as people name them: `12`, `12-15`.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Lines of a file from 1, header included, as in [`Observation::line`](crate::Observation::line); the last one belongs to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LineRange {
    first: u64,
    last: u64,
}

impl LineRange {
    /// The lines between two of them, both included, whichever comes first.
    pub fn between(one: u64, other: u64) -> Self {
        Self { first: one.min(other), last: one.max(other) }
    }

    /// The first of them and the last.
    pub fn ends(self) -> [u64; 2] {
        [self.first, self.last]
    }

    /// True for one of these lines.
    pub fn contains(self, line: u64) -> bool {
        (self.first..=self.last).contains(&line)
    }

    /// True when it is one line.
    pub fn is_one(self) -> bool {
        self.first == self.last
    }
}

impl From<u64> for LineRange {
    fn from(line: u64) -> Self {
        Self { first: line, last: line }
    }
}

/// `line 12`, `lines 12-15`.
impl fmt::Display for LineRange {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_one() {
            write!(out, "line {}", self.first)
        } else {
            write!(out, "lines {}-{}", self.first, self.last)
        }
    }
}

/// A text that names no lines.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{0}` names no lines: write one line (12) or a range, its lower line first (12-15)")]
pub struct NoLines(pub String);

impl FromStr for LineRange {
    type Err = NoLines;

    fn from_str(text: &str) -> Result<Self, NoLines> {
        let line = |part: &str| part.trim().parse::<u64>().map_err(|_| NoLines(text.to_owned()));
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        let range = Self { first: line(first)?, last: line(last)? };
        if range.first <= range.last { Ok(range) } else { Err(NoLines(text.to_owned())) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_a_range_are_read_as_they_are_shown() {
        for (text, shown) in [("12", "line 12"), ("12-15", "lines 12-15"), (" 3 - 3 ", "line 3")] {
            assert_eq!(text.parse::<LineRange>().unwrap().to_string(), shown);
        }
    }

    #[test]
    fn what_names_no_lines_is_refused() {
        for text in ["", "x", "-3", "3-", "15-12", "1.5", "1-2-3", "99999999999999999999"] {
            assert_eq!(text.parse::<LineRange>(), Err(NoLines(text.to_owned())), "{text}");
        }
    }

    #[test]
    fn both_ends_belong_to_a_range() {
        assert_eq!(
            [11, 12, 15, 16].map(|line| LineRange::between(15, 12).contains(line)),
            [false, true, true, false]
        );
    }
}
