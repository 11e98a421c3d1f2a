//! The unit of work: the results of some consecutive trials.

use std::ops::Range;

use crate::sweep::columns::{Column, Kind, Status};

/// Code of an empty count or word.
pub const EMPTY: u8 = u8::MAX;

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers, NaN for none.
    Numbers(Vec<f64>),
    /// Counts, or codes of words; [`EMPTY`] for none.
    Codes(Vec<u8>),
}

impl Values {
    fn with_capacity(kind: &Kind, rows: usize) -> Self {
        match kind {
            Kind::Number => Self::Numbers(Vec::with_capacity(rows)),
            Kind::Count | Kind::Word(_) => Self::Codes(Vec::with_capacity(rows)),
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
    pub columns: Vec<Values>,
}

impl Shard {
    /// A shard whose results are still to come.
    pub fn empty(number: u64, trials: Range<u64>, columns: &[Column]) -> Self {
        let rows = usize::try_from(trials.end - trials.start).unwrap_or(0);
        let columns = columns.iter().map(|c| Values::with_capacity(&c.kind, rows)).collect();
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
            let none =
                if matches!(column, Values::Numbers(_)) { Value::Code(EMPTY) } else { Value::Number(0.0) };
            column.push(none);
        }
    }

    /// Rows it holds.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Values::len)
    }
}
