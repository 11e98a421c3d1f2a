//! The unit of work: the results of some consecutive trials.

use std::ops::Range;

use crate::sweep::columns::{ColumnKind, Status, TrialColumn};

/// Code of an empty count or word.
pub const EMPTY: u8 = u8::MAX;

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Numbers, NaN for none.
    Numbers(Vec<f64>),
    /// Counts, or codes of words; [`EMPTY`] for none.
    Codes(Vec<u8>),
}

impl ColumnValues {
    fn with_capacity(kind: &ColumnKind, rows: usize) -> Self {
        match kind {
            ColumnKind::Number => Self::Numbers(Vec::with_capacity(rows)),
            ColumnKind::Count | ColumnKind::Word(_) => Self::Codes(Vec::with_capacity(rows)),
        }
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Codes(codes) => codes.len(),
        }
    }

    /// True without values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn push(&mut self, value: Value) {
        match (self, value) {
            (Self::Numbers(values), Value::Number(x)) => values.push(x),
            (Self::Numbers(values), _) => values.push(f64::NAN),
            (Self::Codes(codes), Value::Code(code)) => codes.push(code),
            (Self::Codes(codes), _) => codes.push(EMPTY),
        }
    }

    /// The numbers; empty for a column of codes.
    pub fn numbers(&self) -> &[f64] {
        if let Self::Numbers(values) = self { values } else { &[] }
    }

    /// The codes; empty for a column of numbers.
    pub fn codes(&self) -> &[u8] {
        if let Self::Codes(codes) = self { codes } else { &[] }
    }
}

/// One value of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A count, or the code of a word.
    Code(u8),
}

/// Results of consecutive trials of the whole study.
#[derive(Debug, Clone, PartialEq)]
pub struct Shard {
    /// Number of the shard, from 0.
    pub number: u64,
    /// Its trials.
    pub trials: Range<u64>,
    /// One entry per column, all as long as there are trials.
    pub columns: Vec<ColumnValues>,
}

impl Shard {
    /// A shard whose results are still to come.
    pub fn empty(number: u64, trials: Range<u64>, columns: &[TrialColumn]) -> Self {
        let rows = usize::try_from(trials.end - trials.start).unwrap_or(0);
        let columns = columns.iter().map(|c| ColumnValues::with_capacity(&c.kind, rows)).collect();
        Self { number, trials, columns }
    }

    /// Adds a trial with an answer: one value for each column after the status.
    pub fn push(&mut self, values: impl IntoIterator<Item = Value>) {
        let status = Value::Code(Status::Done as u8);
        let row = std::iter::once(status).chain(values);
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }

    /// Adds a trial without an answer.
    pub fn push_failed(&mut self, status: Status) {
        let (first, others) = self.columns.split_at_mut(1);
        for column in first {
            column.push(Value::Code(status as u8));
        }
        for column in others {
            // No number is a code and no code a number: either leaves the value empty.
            let none = if matches!(column, ColumnValues::Numbers(_)) {
                Value::Code(EMPTY)
            } else {
                Value::Number(0.0)
            };
            column.push(none);
        }
    }

    /// Rows it holds.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, ColumnValues::len)
    }

    /// As a journal keeps it: column after column, numbers as 8 B each (little-endian), codes as 1 B each.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for column in &self.columns {
            match column {
                ColumnValues::Numbers(values) => values.iter().for_each(|x| bytes.extend(x.to_le_bytes())),
                ColumnValues::Codes(codes) => bytes.extend(codes),
            }
        }
        bytes
    }

    /// An empty shard filled with what [`Self::to_bytes`] gave; none when the length does not fit.
    pub fn filled(mut self, mut rest: &[u8]) -> Option<Self> {
        let rows = usize::try_from(self.trials.end - self.trials.start).ok()?;
        for column in &mut self.columns {
            let size = if matches!(column, ColumnValues::Numbers(_)) { 8 } else { 1 };
            let (own, others) = rest.split_at_checked(rows.checked_mul(size)?)?;
            match column {
                ColumnValues::Numbers(values) => {
                    values.extend(own.as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)));
                }
                ColumnValues::Codes(codes) => codes.extend(own),
            }
            rest = others;
        }
        rest.is_empty().then_some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shard_comes_back_bit_by_bit() {
        let empty = || Shard::empty(7, 14..16, &crate::sweep::columns::of_springs());
        let mut shard = empty();
        let numbers = [0.25, -1.0, 3.0, 1e-9, 5.0, 6.0].map(Value::Number);
        shard.push(numbers.into_iter().chain([Value::Code(5)]).chain([0.1, 0.2, 0.3].map(Value::Number)));
        shard.push_failed(Status::NotVisible);
        let bytes = shard.to_bytes();
        let back = empty().filled(&bytes).unwrap();
        assert_eq!(back.to_bytes(), bytes);
        assert_eq!(back.columns[1].numbers()[0].to_bits(), 0.25_f64.to_bits());
        assert!(back.columns[1].numbers()[1].is_nan());
        assert!(empty().filled(&bytes[1..]).is_none());
    }
}
