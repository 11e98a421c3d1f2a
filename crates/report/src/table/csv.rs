//! A table as comma-separated values.

use std::io::{self, Write};

use hexbench_core::files::{CsvText, csv_cell, csv_words};

use super::{Frame, TableValues};
use crate::page::{Cell, Table};

/// A table of texts with its header.
pub fn text(table: &Table) -> String {
    let mut text = CsvText::new(table.columns.iter().map(|c| &c.title));
    table.rows.iter().for_each(|row| text.row(row.iter().map(Cell::text)));
    text.into_text()
}

pub(super) fn write(frame: &Frame, out: &mut (dyn Write + Send)) -> io::Result<()> {
    out.write_all(CsvText::new(frame.columns.iter().map(|column| &column.name)).into_text().as_bytes())?;
    for row in 0..frame.rows() {
        for (k, column) in frame.columns.iter().enumerate() {
            if k > 0 {
                out.write_all(b",")?;
            }
            match &column.values {
                TableValues::Numbers(all) => number(out, all[row])?,
                TableValues::Integers(all) => write!(out, "{}", all[row])?,
                TableValues::Words(all) => out.write_all(all[row].as_bytes())?,
                TableValues::Texts(all) => out.write_all(csv_cell(&csv_words(&all[row])).as_bytes())?,
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// The shortest decimals that read back as the same number; nothing for none.
fn number(out: &mut dyn Write, x: f64) -> io::Result<()> {
    // Adding zero turns -0 into 0.
    let (x, size) = (x + 0.0, x.abs());
    match size {
        _ if !size.is_finite() => Ok(()),
        _ if size == 0.0 || (1e-5..1e15).contains(&size) => write!(out, "{x}"),
        _ => write!(out, "{x:e}"),
    }
}

#[cfg(test)]
mod tests {
    use crate::table::{DataColumn, Frame, TableFormat, TableValues};

    #[test]
    fn numbers_read_back_as_they_were_and_missing_ones_are_empty() {
        let numbers = vec![0.1, -0.0, 1.0 / 3.0, f64::NAN, 6.02e23, -1.5e-9];
        let column = |name: &str, values| DataColumn {
            name: name.into(),
            unit: "um".into(),
            meaning: String::new(),
            values,
        };
        let words = TableValues::Words(vec!["training"; 6]);
        let columns = vec![
            column("row", TableValues::Integers((1..=6).collect())),
            column("x_um", TableValues::Numbers(numbers.clone())),
            column("part", words),
        ];
        let mut out = Vec::new();
        Frame { format: "test/1", origin: Vec::new(), columns }.write(TableFormat::Csv, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("row,x_um,part"));
        for (k, line) in lines.enumerate() {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!((cells[0], cells[2]), ((k + 1).to_string().as_str(), "training"));
            assert_eq!(cells[1].parse().ok(), Some(numbers[k]).filter(|x| !x.is_nan()), "{line}");
        }
        assert!(text.contains("\n2,0,training"), "{text}");
    }
}
