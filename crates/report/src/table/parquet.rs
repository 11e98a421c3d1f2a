//! A table as Parquet, and the columns of such a file for writers that go through a table part by part.
//!
//! Nothing in a file depends on the clock or the machine: equal tables are equal bytes.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, ZstdLevel};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder, WriterVersion};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

pub use parquet::basic::Type as Physical;
pub use parquet::errors::ParquetError;
pub use parquet::file::metadata::KeyValue;

use super::{DataColumn, Frame, TableValues};

/// Rows of a row group.
pub const ROWS: usize = 1 << 16;

/// A file while it is written.
pub type File<'a> = SerializedFileWriter<&'a mut (dyn Write + Send)>;
/// A row group while it is written.
pub type RowGroup<'g, 'a> = SerializedRowGroupWriter<'g, &'a mut (dyn Write + Send)>;

pub(super) fn write(frame: &Frame, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let fields = frame.columns.iter().map(field_of).collect::<Result<_, _>>().map_err(other)?;
    let metadata = metadata(frame)?;
    let properties = properties(metadata).build();
    let mut file = begin(out, frame.format, fields, properties)?;
    for start in (0..frame.rows()).step_by(ROWS) {
        let rows = start..(start + ROWS).min(frame.rows());
        let mut group = file.next_row_group().map_err(other)?;
        frame.columns.iter().try_for_each(|c| values(&mut group, &c.values, rows.clone())).map_err(other)?;
        group.close().map_err(other)?;
    }
    file.close().map(drop).map_err(other)
}

/// Begins a file with these fields.
///
/// # Errors
/// What the destination reports.
pub fn begin<'a>(
    out: &'a mut (dyn Write + Send),
    name: &str,
    fields: Vec<TypePtr>,
    properties: WriterProperties,
) -> io::Result<File<'a>> {
    let schema = Type::group_type_builder(name).with_fields(fields).build().map_err(other)?;
    SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties)).map_err(other)
}

/// How all files are written, with these notes in them.
pub fn properties(metadata: Vec<KeyValue>) -> WriterPropertiesBuilder {
    WriterProperties::builder()
        .set_writer_version(WriterVersion::PARQUET_1_0)
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_created_by(format!("hexbench {}", env!("CARGO_PKG_VERSION")))
        .set_max_row_group_row_count(Some(ROWS))
        .set_key_value_metadata(Some(metadata))
}

/// Format, origin, and unit and meaning of every column, as JSON under `fields`.
fn metadata(frame: &Frame) -> io::Result<Vec<KeyValue>> {
    let of = |c: &DataColumn| (c.name.clone(), serde_json::json!({ "unit": c.unit, "meaning": c.meaning }));
    let fields: serde_json::Map<_, _> = frame.columns.iter().map(of).collect();
    let pair = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let mut all = vec![pair("format", frame.format.to_owned())];
    all.extend(frame.origin.iter().map(|(key, value)| pair(key, value.clone())));
    all.push(pair("fields", serde_json::to_string(&fields)?));
    Ok(all)
}

fn field_of(column: &DataColumn) -> Result<TypePtr, ParquetError> {
    match column.values {
        TableValues::Numbers(_) => optional(&column.name, Physical::DOUBLE),
        TableValues::Integers(_) => required(&column.name, Physical::INT64),
        TableValues::Words(_) | TableValues::Texts(_) => required(&column.name, Physical::BYTE_ARRAY),
    }
}

/// A field whose values may be missing; a byte array is text.
///
/// # Errors
/// [`ParquetError`] for a kind that cannot be.
pub fn optional(name: &str, kind: Physical) -> Result<TypePtr, ParquetError> {
    field(name, kind, Repetition::OPTIONAL)
}

/// A field that every row has; a byte array is text.
///
/// # Errors
/// As [`optional`].
pub fn required(name: &str, kind: Physical) -> Result<TypePtr, ParquetError> {
    field(name, kind, Repetition::REQUIRED)
}

fn field(name: &str, kind: Physical, repetition: Repetition) -> Result<TypePtr, ParquetError> {
    let text = (kind == Physical::BYTE_ARRAY).then_some(LogicalType::String);
    let built = Type::primitive_type_builder(name, kind).with_repetition(repetition).with_logical_type(text);
    Ok(Arc::new(built.build()?))
}

fn values(
    group: &mut RowGroup<'_, '_>,
    values: &TableValues,
    rows: std::ops::Range<usize>,
) -> Result<(), ParquetError> {
    match values {
        TableValues::Numbers(all) => numbers(group, &all[rows]),
        TableValues::Integers(all) => int64(group, &all[rows]),
        TableValues::Words(all) => {
            let words: Vec<ByteArray> = all[rows].iter().map(|word| ByteArray::from(*word)).collect();
            text(group, &words, None)
        }
        TableValues::Texts(all) => {
            let words: Vec<ByteArray> = all[rows].iter().map(|word| ByteArray::from(word.as_str())).collect();
            text(group, &words, None)
        }
    }
}

/// Whole numbers, a required field.
///
/// # Errors
/// [`ParquetError`] when the schema differs or the destination fails; so for all functions below.
pub fn int64(group: &mut RowGroup<'_, '_>, values: &[i64]) -> Result<(), ParquetError> {
    write_column(group, |column| match column {
        ColumnWriter::Int64ColumnWriter(typed) => typed.write_batch(values, None, None),
        _ => Err(mismatch()),
    })
}

/// Numbers, a required field.
///
/// # Errors
/// As [`int64`].
pub fn double(group: &mut RowGroup<'_, '_>, values: &[f64]) -> Result<(), ParquetError> {
    write_column(group, |column| match column {
        ColumnWriter::DoubleColumnWriter(typed) => typed.write_batch(values, None, None),
        _ => Err(mismatch()),
    })
}

/// Numbers, an optional field, NaN as null.
///
/// # Errors
/// As [`int64`].
pub fn numbers(group: &mut RowGroup<'_, '_>, values: &[f64]) -> Result<(), ParquetError> {
    let levels: Vec<i16> = values.iter().map(|x| i16::from(!x.is_nan())).collect();
    let present: Vec<f64> = values.iter().copied().filter(|x| !x.is_nan()).collect();
    write_column(group, |column| match column {
        ColumnWriter::DoubleColumnWriter(typed) => typed.write_batch(&present, Some(&levels), None),
        _ => Err(mismatch()),
    })
}

/// Counts that are present, an optional field; levels are 1 where a row has one, 0 where not.
///
/// # Errors
/// As [`int64`].
pub fn counts(group: &mut RowGroup<'_, '_>, present: &[i32], levels: &[i16]) -> Result<(), ParquetError> {
    write_column(group, |column| match column {
        ColumnWriter::Int32ColumnWriter(typed) => typed.write_batch(present, Some(levels), None),
        _ => Err(mismatch()),
    })
}

/// Text, an optional field when there are levels.
///
/// # Errors
/// As [`int64`].
pub fn text(
    group: &mut RowGroup<'_, '_>,
    present: &[ByteArray],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    write_column(group, |column| match column {
        ColumnWriter::ByteArrayColumnWriter(typed) => typed.write_batch(present, levels, None),
        _ => Err(mismatch()),
    })
}

fn write_column(
    group: &mut RowGroup<'_, '_>,
    fill: impl FnOnce(&mut ColumnWriter<'_>) -> Result<usize, ParquetError>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("the schema has fewer columns".into());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    fill(column.untyped())?;
    column.close()
}

fn mismatch() -> ParquetError {
    ParquetError::General("the schema has another type".into())
}

/// As an error of the destination: a full disk must be told as such.
pub fn other(cause: ParquetError) -> io::Error {
    match cause {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(cause) => *cause,
            Err(inner) => io::Error::other(inner),
        },
        cause => io::Error::other(cause),
    }
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;
    use crate::table::TableFormat;

    fn frame(rows: usize) -> Frame {
        let column = |name: &str, values| DataColumn {
            name: name.into(),
            unit: "um".into(),
            meaning: format!("{name} as measured"),
            values,
        };
        let number = |k: usize| if k % 3 == 1 { f64::NAN } else { k as f64 / 7.0 };
        let columns = vec![
            column("line", TableValues::Integers((0..).take(rows).collect())),
            column("da_um", TableValues::Numbers((0..rows).map(number).collect())),
            column("part", TableValues::Words((0..rows).map(|k| ["training", "holdout"][k % 2]).collect())),
        ];
        Frame { format: "test/1", origin: vec![("seed".into(), "7".into())], columns }
    }

    fn reread(frame: &Frame) -> SerializedFileReader<std::fs::File> {
        let mut file = tempfile::tempfile().unwrap();
        frame.write(TableFormat::Parquet, &mut file).unwrap();
        SerializedFileReader::new(file).unwrap()
    }

    #[test]
    fn a_table_of_several_row_groups_reads_back() {
        let rows = ROWS + 10;
        let reader = reread(&frame(rows));
        assert_eq!(reader.metadata().num_row_groups(), 2);
        let mut seen = 0;
        for (k, row) in reader.get_row_iter(None).unwrap().map(Result::unwrap).enumerate() {
            assert_eq!(usize::try_from(row.get_long(0).unwrap()), Ok(k));
            assert_eq!(row.get_double(1).ok(), (k % 3 != 1).then(|| k as f64 / 7.0), "row {k}");
            assert_eq!(row.get_string(2).unwrap(), ["training", "holdout"][k % 2]);
            seen += 1;
        }
        assert_eq!(seen, rows);
    }

    #[test]
    fn units_meanings_and_origin_are_in_the_file() {
        let reader = reread(&frame(3));
        let notes = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
        let note = |key: &str| notes.iter().find(|n| n.key == key).and_then(|n| n.value.clone()).unwrap();
        assert_eq!((note("format"), note("seed")), ("test/1".into(), "7".into()));
        let fields: serde_json::Value = serde_json::from_str(&note("fields")).unwrap();
        assert_eq!(fields["da_um"]["unit"], "um");
        assert_eq!(fields["part"]["meaning"], "part as measured");
    }

    #[test]
    fn an_empty_table_is_a_table() {
        let reader = reread(&frame(0));
        assert_eq!(reader.get_row_iter(None).unwrap().count(), 0);
    }
}
