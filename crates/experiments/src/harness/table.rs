//! The table of trials: one row each, whatever the experiment.

use hexbench_report::table::{DataColumn, Frame, TableValues};

use super::{Gathered, Protocol};

/// A value of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum RecordValue {
    /// NaN for none.
    Number(f64),
    /// Empty for none.
    Text(String),
}

/// A column of the table of trials: of numbers without a unit, or of words.
pub struct Field<R> {
    /// Name.
    pub name: String,
    /// `1` for numbers, empty for words.
    unit: &'static str,
    /// What it is, in one sentence.
    pub meaning: &'static str,
    value: Box<dyn Fn(&R) -> RecordValue>,
}

impl<R> Field<R> {
    /// A column of numbers.
    pub fn number<N: Into<Option<f64>>>(
        name: impl Into<String>,
        meaning: &'static str,
        value: impl Fn(&R) -> N + 'static,
    ) -> Self {
        let value = Box::new(move |record: &R| RecordValue::Number(value(record).into().unwrap_or(f64::NAN)));
        Self { name: name.into(), unit: "1", meaning, value }
    }

    /// A column of numbers: 1 where something is so, else 0.
    pub fn flag(name: &str, meaning: &'static str, value: impl Fn(&R) -> bool + 'static) -> Self {
        Self::number(name, meaning, move |record| f64::from(u8::from(value(record))))
    }

    /// A column of words.
    pub fn text<S: Into<String>>(
        name: &str,
        meaning: &'static str,
        value: impl Fn(&R) -> S + 'static,
    ) -> Self {
        let value = Box::new(move |record: &R| RecordValue::Text(value(record).into()));
        Self { name: name.to_owned(), unit: "", meaning, value }
    }

    /// The same column of records that hold such ones.
    pub fn of<S>(self, part: impl Fn(&S) -> &R + 'static) -> Field<S>
    where
        R: 'static,
    {
        let Self { name, unit, meaning, value } = self;
        Field { name, unit, meaning, value: Box::new(move |record| value(part(record))) }
    }
}

/// The table of the trials of an experiment: number, name, why there is no answer, then the fields of the records.
pub fn table<P: Protocol>(protocol: &P, gathered: &Gathered<P::Record>) -> Frame {
    let identity = protocol.identity();
    let names = protocol.jobs().iter().map(|job| protocol.name(job)).collect();
    let failures = gathered.answers.iter().map(|a| a.as_ref().err().cloned().unwrap_or_default());
    let mut columns = vec![
        DataColumn::new(
            "trial",
            "1",
            "number of the trial, from 0",
            TableValues::Integers((0..).take(gathered.answers.len()).collect()),
        ),
        DataColumn::new("name", "", "what the trial is called", TableValues::Texts(names)),
        DataColumn::new(
            "failure",
            "",
            "why the trial has no answer; empty when it has one",
            TableValues::Texts(failures.collect()),
        ),
    ];
    let filled = |field: Field<P::Record>| {
        DataColumn::new(&field.name, field.unit, field.meaning, values(&field, gathered))
    };
    columns.extend(protocol.fields().into_iter().map(filled));
    Frame { format: identity.format, origin: identity.inputs.into_iter().collect(), columns }
}

fn values<R>(field: &Field<R>, gathered: &Gathered<R>) -> TableValues {
    let cells =
        gathered.answers.iter().map(|answer| answer.as_ref().ok().map(|record| (field.value)(record)));
    if field.unit.is_empty() {
        TableValues::Texts(
            cells
                .map(|cell| if let Some(RecordValue::Text(text)) = cell { text } else { String::new() })
                .collect(),
        )
    } else {
        TableValues::Numbers(
            cells.map(|cell| if let Some(RecordValue::Number(x)) = cell { x } else { f64::NAN }).collect(),
        )
    }
}
