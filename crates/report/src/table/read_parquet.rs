//! A Parquet file as records.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use hexbench_core::files::{Fault, FileError, FilePlace, FileProblem, Records};
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, RowGroupMetaData};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

/// How a file of this format begins.
const BEGINNING: [u8; 4] = *b"PAR1";
const PLAIN_COLUMNS: &str = "Write plain columns of numbers, named as in measurements.csv; or write CSV.";
const OTHER_COMPRESSION: &str =
    "Write the file with snappy, zstd, gzip or lz4, or without compression; or write CSV.";

/// True for the name of a file that begins as Parquet.
pub fn is_parquet(path: &Path) -> bool {
    let mut beginning = [0; BEGINNING.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut beginning));
    read.is_ok() && beginning == BEGINNING
}

/// Rows of a Parquet file with plain columns, compressed with snappy, zstd, gzip or lz4, or not at all; words and numbers are cells, null
/// is an empty one.
///
/// # Errors
/// A file that cannot be opened or is damaged, another compression, and a column that contains neither numbers nor words.
pub fn read_parquet(path: &Path) -> Result<Records, FileError> {
    let file = File::open(path).map_err(|cause| Fault::from(cause).in_file(path))?;
    records(file).map_err(|wrong| {
        let (rule, next) = match wrong {
            ParquetError::NYI(why) => (why, OTHER_COMPRESSION),
            ParquetError::General(why) => (why, PLAIN_COLUMNS),
            other => (other.to_string(), PLAIN_COLUMNS),
        };
        Fault::new(FilePlace::file(), FileProblem::Rule { rule, next: next.to_owned() }).in_file(path)
    })
}

/// Refuses what no reader of this build unpacks.
fn refuse_compression(reader: &SerializedFileReader<File>) -> Result<(), ParquetError> {
    let groups = reader.metadata().row_groups();
    let unread = |column: &ColumnChunkMetaData| match column.compression() {
        Compression::BROTLI(_) => Some("brotli"),
        Compression::LZO => Some("lzo"),
        _ => None,
    };
    match groups.iter().flat_map(RowGroupMetaData::columns).find_map(unread) {
        Some(name) => Err(ParquetError::NYI(format!("the columns are compressed with {name}"))),
        None => Ok(()),
    }
}

fn records(file: File) -> Result<Records, ParquetError> {
    let reader = SerializedFileReader::new(file)?;
    refuse_compression(&reader)?;
    let columns = reader.metadata().file_metadata().schema().get_fields();
    let names = columns.iter().map(|field| field.name().to_owned()).collect();
    let mut rows = Vec::new();
    for row in reader.get_row_iter(None)? {
        rows.push(row?.get_column_iter().map(cell).collect::<Result<_, _>>()?);
    }
    Ok(Records { names, rows })
}

fn cell((name, field): (&String, &Field)) -> Result<Option<String>, ParquetError> {
    match field {
        Field::Null => Ok(None),
        Field::Double(value) => Ok((!value.is_nan()).then(|| value.to_string())),
        Field::Float(value) => Ok((!value.is_nan()).then(|| value.to_string())),
        Field::Str(value) => Ok(Some(value.clone())),
        Field::Byte(_)
        | Field::Short(_)
        | Field::Int(_)
        | Field::Long(_)
        | Field::UByte(_)
        | Field::UShort(_)
        | Field::UInt(_)
        | Field::ULong(_) => Ok(Some(field.to_string())),
        _ => Err(ParquetError::General(format!("column {name} contains neither numbers nor words"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{DataColumn, Frame, TableValues};

    #[test]
    fn what_is_written_is_read_again_and_a_missing_number_is_an_empty_cell() {
        let column = |name: &str, values| DataColumn {
            name: name.to_owned(),
            unit: String::new(),
            meaning: String::new(),
            values,
        };
        let columns = vec![
            column("pose", TableValues::Integers(vec![1, 2])),
            column("fz_N", TableValues::Numbers(vec![-100.5, f64::NAN])),
            column("note", TableValues::Texts(vec!["warm".to_owned(), String::new()])),
        ];
        let frame = Frame { format: "readings/1", origin: Vec::new(), columns };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table");
        super::super::parquet::write(&frame, &mut File::create(&path).unwrap()).unwrap();
        assert!(is_parquet(&path));
        let records = read_parquet(&path).unwrap();
        assert_eq!(records.names, ["pose", "fz_N", "note"]);
        let texts: Vec<Option<&str>> = records.rows.iter().flatten().map(Option::as_deref).collect();
        assert_eq!(texts, [Some("1"), Some("-100.5"), Some("warm"), Some("2"), None, Some("")]);
    }

    #[test]
    fn a_damaged_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table");
        std::fs::write(&path, "PAR1 and nothing else").unwrap();
        assert!(is_parquet(&path));
        assert!(!read_parquet(&path).unwrap_err().next_step().is_empty());
    }
}
