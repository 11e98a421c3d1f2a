//! A share of an experiment: what one of several processes or machines computes.

use std::fmt;
use std::str::FromStr;

/// Most parts an experiment is divided into.
const MOST: u64 = 100_000;

/// Every `of`-th shard, beginning with the `number`-th: cells of unequal cost are shared out evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExperimentPart {
    number: u64,
    of: u64,
}

impl ExperimentPart {
    /// Part `number`, from 1, of `of`; none when there is no such part.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        ((1..=of).contains(&number) && of <= MOST).then_some(Self { number, of })
    }

    /// All parts of an experiment divided in `of`.
    pub fn all(of: u64) -> impl Iterator<Item = Self> {
        (1..=of).filter_map(move |number| Self::new(number, of))
    }

    /// True when a shard belongs to this part.
    pub fn holds(self, shard: u64) -> bool {
        shard % self.of == self.number - 1
    }
}

impl fmt::Display for ExperimentPart {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}/{}", self.number, self.of)
    }
}

/// A text that names no part.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("write a part as i/n with 1 <= i <= n <= {MOST}, for example 2/8")]
pub struct NoPart;

impl FromStr for ExperimentPart {
    type Err = NoPart;

    fn from_str(text: &str) -> Result<Self, NoPart> {
        let (number, of) = text.split_once('/').ok_or(NoPart)?;
        let whole = |digits: &str| digits.parse().map_err(|_| NoPart);
        Self::new(whole(number)?, whole(of)?).ok_or(NoPart)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shard_belongs_to_exactly_one_part() {
        for of in 1..12 {
            for shard in 0..100 {
                assert_eq!(
                    ExperimentPart::all(of).filter(|part| part.holds(shard)).count(),
                    1,
                    "{shard} of {of}"
                );
            }
        }
    }

    #[test]
    fn a_part_is_read_as_it_is_written() {
        for text in ["1/1", "2/8", "100000/100000"] {
            assert_eq!(text.parse::<ExperimentPart>().unwrap().to_string(), text);
        }
        for text in ["", "3", "0/4", "5/4", "1/0", "-1/2", "1/100001", "1/2/3", "a/b"] {
            assert_eq!(text.parse::<ExperimentPart>(), Err(NoPart), "{text}");
        }
    }
}
