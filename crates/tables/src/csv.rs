//! A table as comma-separated values.

use std::io::{self, Write};

use crate::{Frame, Values};

pub(super) fn write(frame: &Frame, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let names: Vec<&str> = frame.columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(out, "{}", names.join(","))?;
    for row in 0..frame.rows() {
        for (k, column) in frame.columns.iter().enumerate() {
            if k > 0 {
                out.write_all(b",")?;
            }
            match &column.values {
                Values::Numbers(all) => number(out, all[row])?,
                Values::Integers(all) => write!(out, "{}", all[row])?,
                Values::Words(all) => out.write_all(all[row].as_bytes())?,
                Values::Texts(all) => text(out, &all[row])?,
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// In quotes where it has to be (RFC 4180).
fn text(out: &mut dyn Write, words: &str) -> io::Result<()> {
    if words.contains(['"', ',', '\n', '\r']) {
        write!(out, "\"{}\"", words.replace('"', "\"\""))
    } else {
        out.write_all(words.as_bytes())
    }
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
    use crate::{Column, Frame, Kind, Values};

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
