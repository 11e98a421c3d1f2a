//! Tables for other programs: named columns with unit and meaning, written as CSV or Parquet.
//!
//! pandas, polars and xarray read both without options: UTF-8, one header line, a dot for decimals, an empty cell (null in
//! Parquet) for a number that does not exist.

pub mod csv;
pub mod parquet;
mod read_parquet;
pub mod run_sheet;

use std::io::{self, Write};
use std::path::Path;

pub use read_parquet::{is_parquet, read_parquet};

/// Values of a column, one per row.
#[derive(Debug, Clone, PartialEq)]
pub enum TableValues {
    /// Numbers; NaN where there is none.
    Numbers(Vec<f64>),
    /// Whole numbers.
    Integers(Vec<i64>),
    /// Words.
    Words(Vec<&'static str>),
    /// Words of any origin.
    Texts(Vec<String>),
}

impl TableValues {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(all) => all.len(),
            Self::Integers(all) => all.len(),
            Self::Words(all) => all.len(),
            Self::Texts(all) => all.len(),
        }
    }
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct DataColumn {
    /// Name with its unit: `da_um`.
    pub name: String,
    /// Unit, `1` for a number without, empty for words.
    pub unit: String,
    /// What it is, in one sentence.
    pub meaning: String,
    /// Its values.
    pub values: TableValues,
}

impl DataColumn {
    /// A column with this name, unit and meaning.
    pub fn new(
        name: impl Into<String>,
        unit: impl Into<String>,
        meaning: impl Into<String>,
        values: TableValues,
    ) -> Self {
        Self { name: name.into(), unit: unit.into(), meaning: meaning.into(), values }
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Name of its format, with version: `readings/1`.
    pub format: &'static str,
    /// What it was made from, and by what.
    pub origin: Vec<(String, String)>,
    /// Its columns, all of the same length.
    pub columns: Vec<DataColumn>,
}

/// Kinds of file a table is written as, by the end of their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// `.csv`
    Csv,
    /// `.parquet`
    Parquet,
}

impl TableFormat {
    /// The kind a file name asks for; none when it ends neither in `.csv` nor in `.parquet`.
    pub fn of(path: &Path) -> Option<Self> {
        let ends = |with: &str| path.extension().is_some_and(|end| end.eq_ignore_ascii_case(with));
        match (ends("csv"), ends("parquet")) {
            (true, _) => Some(Self::Csv),
            (_, true) => Some(Self::Parquet),
            _ => None,
        }
    }
}

impl Frame {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Writes the table.
    ///
    /// # Errors
    /// Whatever the destination reports; columns of different lengths.
    pub fn write(&self, kind: TableFormat, out: &mut (dyn Write + Send)) -> io::Result<()> {
        if let Some(odd) = self.columns.iter().find(|column| column.values.len() != self.rows()) {
            return Err(io::Error::other(format!("column {} has another length than the first", odd.name)));
        }
        match kind {
            TableFormat::Csv => csv::write(self, out),
            TableFormat::Parquet => parquet::write(self, out),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_name_tells_the_kind() {
        assert_eq!(TableFormat::of(Path::new("a/b.csv")), Some(TableFormat::Csv));
        assert_eq!(TableFormat::of(Path::new("b.Parquet")), Some(TableFormat::Parquet));
        assert_eq!(TableFormat::of(Path::new("csv")), None);
        assert_eq!(TableFormat::of(Path::new("-")), None);
    }

    #[test]
    fn columns_of_different_lengths_are_refused() {
        let column = |name: &str, n: usize| DataColumn {
            name: name.into(),
            unit: "1".into(),
            meaning: String::new(),
            values: TableValues::Integers(vec![0; n]),
        };
        let frame = Frame { columns: vec![column("a", 2), column("b", 3)], ..Frame::default() };
        for kind in [TableFormat::Csv, TableFormat::Parquet] {
            let wrong = frame.write(kind, &mut Vec::new()).unwrap_err().to_string();
            assert!(wrong.contains("column b"), "{wrong}");
        }
    }
}
