//! A table as comma-separated values.

use std::borrow::Cow;
use std::io::{self, Write};

use super::{Frame, Values};
use crate::page::Table;

/// A table of texts with its header.
pub fn text(table: &Table) -> String {
    let header = line(table.columns.iter().map(|c| c.title.as_str()));
    let rows = table.rows.iter().map(|row| line(row.iter().map(crate::page::Cell::text)));
    std::iter::once(header).chain(rows).collect()
}

/// One line of cells; those with a comma, a quote or an end of line are quoted.
pub fn line<'a>(cells: impl IntoIterator<Item = &'a str>) -> String {
    let cells: Vec<Cow<'_, str>> = cells.into_iter().map(quoted).collect();
    cells.join(",") + "\n"
}

/// In quotes where it has to be (RFC 4180).
fn quoted(cell: &str) -> Cow<'_, str> {
    if cell.contains(['"', ',', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", cell.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(cell)
    }
}

pub(super) fn write(frame: &Frame, out: &mut (dyn Write + Send)) -> io::Result<()> {
    out.write_all(line(frame.columns.iter().map(|column| column.name.as_str())).as_bytes())?;
    for row in 0..frame.rows() {
        for (k, column) in frame.columns.iter().enumerate() {
            if k > 0 {
                out.write_all(b",")?;
            }
            match &column.values {
                Values::Numbers(all) => number(out, all[row])?,
                Values::Integers(all) => write!(out, "{}", all[row])?,
                Values::Words(all) => out.write_all(all[row].as_bytes())?,
                Values::Texts(all) => out.write_all(quoted(&all[row]).as_bytes())?,
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
    use crate::table::{Column, Frame, Kind, Values};

    #[test]
    fn cells_that_hold_a_comma_or_a_quote_are_quoted() {
        let table = crate::page::Table::named(["what", "n"]).rows([["a, b", "3"], ["\"c\"", "4"]]);
        assert_eq!(super::text(&table), "what,n\n\"a, b\",3\n\"\"\"c\"\"\",4\n");
    }

    #[test]
    fn words_with_commas_and_quotes_stay_in_their_cell() {
        let texts = ["plain", "one, two", "\"no\""].map(str::to_owned).to_vec();
        let (unit, meaning) = (String::new(), String::new());
        let column = Column { name: "why".into(), unit, meaning, values: Values::Texts(texts) };
        let mut out = Vec::new();
        Frame { columns: vec![column], ..Frame::default() }.write(Kind::Csv, &mut out).unwrap();
        assert_eq!(String::from_utf8(out).unwrap(), "why\nplain\n\"one, two\"\n\"\"\"no\"\"\"\n");
    }

    #[test]
    fn numbers_read_back_as_they_were_and_missing_ones_are_empty() {
        let numbers = vec![0.1, -0.0, 1.0 / 3.0, f64::NAN, 6.02e23, -1.5e-9];
        let column = |name: &str, values| Column {
            name: name.into(),
            unit: "um".into(),
            meaning: String::new(),
            values,
        };
        let words = Values::Words(vec!["training"; 6]);
        let columns = vec![
            column("row", Values::Integers((1..=6).collect())),
            column("x_um", Values::Numbers(numbers.clone())),
            column("part", words),
        ];
        let mut out = Vec::new();
        Frame { format: "test/1", origin: Vec::new(), columns }.write(Kind::Csv, &mut out).unwrap();
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
