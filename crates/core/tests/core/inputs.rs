//! A table of inputs as people make them: read as the plain file is read, or refused with the right hint; never misread.

use hexbench_core::files::{ColumnNames, read_balls, read_loads, read_measurements};

use crate::workbooks::{Cell, cells, ods, xlsx};

const HEADER: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
    da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
const ROWS: [&str; 2] = [
    "1,1,6.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,-1.5,2.25,-13.125,-18.5,18.375,61.75",
    "2,1,7.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,-0.5,2.75,-13.25,-12.125,20.75,61.25",
];

fn plain() -> String {
    format!("{HEADER}\n{}\n{}\n", ROWS[0], ROWS[1])
}

/// The plain file with another text in one place.
fn with(from: &str, to: &str) -> String {
    assert!(plain().contains(from), "{from}");
    plain().replace(from, to)
}

fn german() -> String {
    plain().replace(',', ";").replace('.', ",")
}

fn utf16(text: &str, big_endian: bool) -> Vec<u8> {
    let mark = std::iter::once(0xfeff);
    let bytes = |unit: u16| if big_endian { unit.to_be_bytes() } else { unit.to_le_bytes() };
    mark.chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// The sheet of the plain file with one cell changed (row and column from 1).
fn sheet_with(row: usize, column: usize, cell: Cell) -> Vec<Vec<Cell>> {
    let mut rows = cells(&plain());
    rows[row - 1][column - 1] = cell;
    rows
}

/// Rows below and right of an empty margin.
fn with_margin(rows: Vec<Vec<Cell>>) -> Vec<Vec<Cell>> {
    std::iter::once(vec![Cell::Empty]).chain(rows).collect()
}

/// The plain file as an object on every line.
fn json_lines(table: &str) -> String {
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let object = |line: &str| {
        let pairs = names.iter().zip(line.split(',')).map(|(name, cell)| format!("\"{name}\":{cell}"));
        format!("{{{}}}\n", pairs.collect::<Vec<_>>().join(","))
    };
    lines.map(object).collect()
}

enum Meaning {
    /// The same numbers as the plain file, with these words among the warnings; none: no warning.
    Read(&'static str),
    /// An error with these words, and a next step with those.
    Refused(&'static str, &'static str),
}
use Meaning::{Read, Refused};

#[test]
#[expect(clippy::too_many_lines, reason = "a table")]
fn files_as_people_make_them_are_read_or_refused_and_never_misread() {
    let one = |rows: Vec<Vec<Cell>>| xlsx(&[("Tabelle1", rows)]);
    let notes = || vec![vec![Cell::Text("taken in May".into())]];
    let quoted = format!("\"{}\"\n", plain().trim_end().replace(',', "\",\"").replace('\n', "\"\n\""));
    let table: Vec<(&str, Vec<u8>, Meaning)> = vec![
        ("plain", plain().into(), Read("")),
        ("windows line ends", plain().replace('\n', "\r\n").into(), Read("")),
        ("byte order mark", format!("\u{feff}{}", plain()).into(), Read("")),
        ("German Excel", german().into(), Read("decimal comma")),
        ("German Excel with sep=", format!("sep=;\r\n{}", german()).into(), Read("decimal comma")),
        ("tabs, from the clipboard", plain().replace(',', "\t").into(), Read("tabs")),
        ("Unicode text of Excel", utf16(&plain().replace(',', "\t"), false), Read("UTF-16LE")),
        ("UTF-16, the other way", utf16(&plain(), true), Read("UTF-16BE")),
        (
            "Windows-1252",
            with("da_um", "da_@m")
                .into_bytes()
                .into_iter()
                .map(|b| if b == b'@' { 0xb5 } else { b })
                .collect(),
            Read("windows-1252"),
        ),
        ("quoted cells", quoted.into(), Read("")),
        ("units in brackets", with("fz_N", "fz [N]").into(), Read("")),
        (
            "units in a second row",
            with("gamma_deg,fx", "gamma_deg,fx")
                .replacen('\n', "\n-,-,mm,mm,mm,deg,deg,deg,N,N,N,N·m,N·m,N·m,um,um,um,urad,urad,urad\n", 1)
                .into(),
            Read(""),
        ),
        ("empty columns at the end", plain().replace('\n', ",,\n").into(), Read("")),
        ("empty rows at the end", format!("{}{}\n", plain(), ",".repeat(19)).into(), Read("")),
        ("a comment above", format!("# bench 3\n{}", plain()).into(), Read("")),
        (
            "a column of notes",
            with("dgamma_urad", "dgamma_urad,note")
                .replace("61.75", "61.75,warm")
                .replace("61.25", "61.25,")
                .into(),
            Read(""),
        ),
        ("no last newline", plain().trim_end().into(), Read("does not end with a newline")),
        ("capitals", with("fz_N", "FZ_N").into(), Read("")),
        ("kilonewtons", with("fz_N", "fz_kN").replace("-338.5", "-0.3385").into(), Read("")),
        (
            "arcseconds",
            with("alpha_deg", "alpha_arcsec").replacen("-7.5,0.75", "-27000,0.75", 2).into(),
            Read(""),
        ),
        ("JSON lines", json_lines(&plain()).into(), Read("")),
        ("JSON lines with a blank line", json_lines(&plain()).replace("}\n", "}\n\n").into(), Read("")),
        (
            "JSON lines, a word",
            json_lines(&plain()).replace("2.75", "\"warm\"").into(),
            Refused("line 2 (db_um): \"warm\": this is not a number", ""),
        ),
        (
            "JSON lines, another name",
            json_lines(&plain()).replacen("{\"pose\":2", "{\"Pose\":2", 1).into(),
            Refused("line 2: Pose is not in the first object", "same names"),
        ),
        (
            "JSON lines, a list in a cell",
            json_lines(&plain()).replace("2.75", "[2.75]").into(),
            Refused("line 2: db_um is no number", ""),
        ),
        (
            "JSON lines, an empty cell",
            json_lines(&plain()).replace("2.75", "null").into(),
            Refused("line 2 (db_um): the cell is empty", ""),
        ),
        (
            "JSON lines without a unit",
            json_lines(&plain()).replace("fz_N", "fz").into(),
            Refused("fz: the name states no unit", "fz_N"),
        ),
        (
            "one JSON value",
            "{\n \"pose\": [1, 2]\n}\n".into(),
            Refused("line 1: this line is no JSON object", "one object a line"),
        ),
        ("xlsx", one(cells(&plain())), Read("")),
        ("ods", ods(&[("Blatt1", cells(&plain()))]), Read("")),
        ("xlsx, one of two sheets", xlsx(&[("Notes", notes()), ("Measurements", cells(&plain()))]), Read("")),
        ("xlsx with an empty row above", one(with_margin(cells(&plain()))), Read("")),
        ("xlsx with numbers as text", one(sheet_with(2, 3, Cell::Text("6.5".into()))), Read("")),
        (
            "xlsx, two sheets",
            xlsx(&[("A", cells(&plain())), ("B", notes())]),
            Refused("2 sheets that are not empty: \"A\", \"B\"", "Call the one to be read \"measurements\""),
        ),
        (
            "xlsx, 3.5 became a date",
            one(sheet_with(3, 16, Cell::Date(46_145.0))),
            Refused("sheet \"Tabelle1\", row 3, column 16 (db_um): \"2026-05-03\": this is a date", "text"),
        ),
        (
            "xlsx, division by zero",
            one(sheet_with(3, 1, Cell::Error)),
            Refused("row 3, column 1 (pose): \"error #DIV/0!\"", ""),
        ),
        (
            "xlsx, an empty cell",
            one(sheet_with(3, 17, Cell::Empty)),
            Refused("row 3, column 17 (dc_um): the cell is empty", ""),
        ),
        (
            "ods, a word",
            ods(&[("Blatt1", sheet_with(2, 4, Cell::Text("four".into())))]),
            Refused("sheet \"Blatt1\", row 2, column 4 (b_mm): \"four\"", ""),
        ),
        (
            "a packed file that is no workbook",
            b"PK\x03\x04 something else".to_vec(),
            Refused("no workbook that can be read", "export the sheet as CSV"),
        ),
        ("a date in text", with("2.75", "3.Mai").into(), Refused("this is a date", "")),
        (
            "thousands separators",
            german().replace("-338,5", "-1.338,5").into(),
            Refused("thousands separators", ""),
        ),
        (
            "a decimal comma in a comma table",
            with(",2.75", ",\"2,75\"").into(),
            Refused("needs a decimal point", ""),
        ),
        ("no header", ROWS.join("\n").into(), Refused("must name the columns", "Add a first line")),
        (
            "a title above the header",
            format!("Bench 3\n{}", plain()).into(),
            Refused("single cell", "begin a title above the header with #"),
        ),
        ("no units", with("fz_N", "fz").into(), Refused("states no unit", "fz_N")),
        (
            "another unit in the second row",
            plain()
                .replacen('\n', "\n,,mm,mm,mm,deg,deg,deg,N,N,kN,Nm,Nm,Nm,um,um,um,urad,urad,urad\n", 1)
                .into(),
            Refused("contradicts", ""),
        ),
        (
            "names of another program",
            with("a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg", "X_mm,Y_mm,Z_mm,Rx_deg,Ry_deg,Rz_deg").into(),
            Refused("missing: a_mm", "X_mm"),
        ),
        ("degrees in radians' column", with("alpha_deg", "alpha_rad").into(), Refused("1.194 turns", "")),
        ("a cut file", plain()[..plain().len() - 30].into(), Refused("the file is cut", "")),
        ("old Macintosh lines", plain().replace('\n', "\r").into(), Refused("bare carriage return", "")),
        ("a web page", "<!DOCTYPE html>\n<html></html>\n".into(), Refused("", "")),
        ("nothing", Vec::new(), Refused("empty", "")),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table");
    std::fs::write(&path, plain()).unwrap();
    let expected = read_measurements(&path).unwrap().dataset;
    assert!(table.len() >= 30);
    for (name, bytes, meaning) in table {
        std::fs::write(&path, bytes).unwrap();
        match (read_measurements(&path), meaning) {
            (Ok(read), Read(told)) => {
                let warnings: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
                let all = warnings.join("; ");
                assert!(if told.is_empty() { all.is_empty() } else { all.contains(told) }, "{name}: {all}");
                for (one, other) in read.dataset.observations.iter().zip(&expected.observations) {
                    let near = |a: [f64; 6], b: [f64; 6]| {
                        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14 * b.abs())
                    };
                    assert!(near(one.pose.to_array(), other.pose.to_array()), "{name}");
                    assert!(near(one.wrench.to_array(), other.wrench.to_array()), "{name}");
                    assert!(near(one.measured, other.measured), "{name}");
                }
                assert_eq!(read.dataset.observations.len(), 2, "{name}");
            }
            (Err(error), Refused(message, next)) => {
                let (said, step) = (error.message(), error.next_step());
                println!("{name}: {said}\n  next: {step}");
                assert!(said.contains(message), "{name}: {said}");
                assert!(step.contains(next) && !step.is_empty(), "{name}: {said}: {step}");
            }
            (Ok(read), Refused(..)) => panic!("{name} is read: {:?}", read.warnings),
            (Err(error), Read(_)) => panic!("{name} is refused: {error}"),
        }
    }
}

#[test]
fn one_workbook_may_hold_balls_and_loads() {
    let balls = "record,ball,x_mm,y_mm,z_mm\nR1,A,1,2,3\nL1,A,1,2,3.01";
    let loads = "record,ref_record,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,mass_kg\nL1,R1,0,0,0,0,0,0,10";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("campaign.ods");
    for book in [ods, xlsx] {
        std::fs::write(&path, book(&[("Balls", cells(balls)), ("Loads", cells(loads))])).unwrap();
        assert_eq!(read_balls(&path).unwrap().len(), 2);
        let table = read_loads(&path, &ColumnNames::default(), None).unwrap();
        assert_eq!(
            (table.rows[0].record.as_str(), table.rows[0].hung.loaded.to_bits()),
            ("L1", 10_f64.to_bits())
        );
        assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    }
    let spoilt = balls.replace("3.01", "three");
    std::fs::write(&path, xlsx(&[("Balls", cells(&spoilt)), ("Loads", cells(loads))])).unwrap();
    let said = read_balls(&path).unwrap_err().message();
    assert_eq!(said, "sheet \"Balls\", row 3, column 5 (z_mm): \"three\": this is not a number");
}
