//! The plain table of measurements as a workbook or as JSON lines.

use super::{Cell, Input, Read, Refused, cells, input, ods, xlsx};

/// The plain file as an object on every line.
pub(super) fn json_lines(table: &str) -> String {
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let object = |line: &str| {
        let pairs = names.iter().zip(line.split(',')).map(|(name, cell)| format!("\"{name}\":{cell}"));
        format!("{{{}}}\n", pairs.collect::<Vec<_>>().join(","))
    };
    lines.map(object).collect()
}

/// Workbooks of the plain table, and JSON lines with something wrong.
pub(super) fn workbooks(plain: &str) -> Vec<Input> {
    let one = |rows: Vec<Vec<Cell>>| xlsx(&[("Tabelle1", rows)]);
    let notes = || vec![vec![Cell::Text("taken in May".into())]];
    // Row and column from 1.
    let with = |row: usize, column: usize, cell: Cell| {
        let mut rows = cells(plain);
        rows[row - 1][column - 1] = cell;
        rows
    };
    let below =
        |rows: Vec<Vec<Cell>>, above: Vec<Cell>| std::iter::once(above).chain(rows).collect::<Vec<_>>();
    let merged = || {
        let mut row = vec![Cell::Empty; 20];
        row[2] = Cell::Text("Pose".into());
        row[8] = Cell::Text("Load".into());
        row
    };
    let text = |words: &str| Cell::Text(words.into());
    let json = |from: &str, to: &str| json_lines(plain).replace(from, to);
    vec![
        input("xlsx", one(cells(plain)), Read("")),
        input("ods", ods(&[("Blatt1", cells(plain))]), Read("")),
        input(
            "xlsx, one of two sheets called Measurements",
            xlsx(&[("Notes", notes()), ("Measurements", cells(plain))]),
            Read(""),
        ),
        input("xlsx with an empty row above", one(below(cells(plain), vec![Cell::Empty])), Read("")),
        input("xlsx with a number kept as text", one(with(2, 3, text("6.5"))), Read("")),
        input("xlsx with a name broken over two lines", one(with(1, 15, text("da\n[um]"))), Read("")),
        input(
            "xlsx, two sheets",
            xlsx(&[("A", cells(plain)), ("B", notes())]),
            Refused("2 sheets that are not empty: \"A\", \"B\"", "Call the one to be read \"measurements\""),
        ),
        input(
            "xlsx, merged cells above the names",
            one(below(cells(plain), merged())),
            Refused("names groups of columns", "begin it with #"),
        ),
        input(
            "xlsx, a number with a decimal comma kept as text",
            one(with(3, 16, text("2,75"))),
            Refused("are mixed", "decimal point"),
        ),
        input(
            "xlsx, 3.5 became a date",
            one(with(3, 16, Cell::Date(46_145.0))),
            Refused("sheet \"Tabelle1\", row 3, column 16 (db_um): \"2026-05-03\": this is a date", "text"),
        ),
        input(
            "xlsx, a formula kept as text",
            one(with(3, 16, text("=P2*2"))),
            Refused("a formula", "values"),
        ),
        input(
            "xlsx, division by zero",
            one(with(3, 1, Cell::Error)),
            Refused("row 3, column 1 (pose): \"error #DIV/0!\": this is not a value", ""),
        ),
        input(
            "xlsx, an empty cell",
            one(with(3, 17, Cell::Empty)),
            Refused("row 3, column 17 (dc_um): the cell is empty", ""),
        ),
        input(
            "ods, a word",
            ods(&[("Blatt1", with(2, 4, text("four")))]),
            Refused("sheet \"Blatt1\", row 2, column 4 (b_mm): \"four\"", ""),
        ),
        input(
            "a packed file that is no workbook",
            b"PK\x03\x04 something else".to_vec(),
            Refused("no workbook that can be read", "export the sheet as CSV"),
        ),
        input(
            "JSON lines, a word",
            json("2.75", "\"warm\""),
            Refused("line 2 (db_um): \"warm\": this is not a number", ""),
        ),
        input(
            "JSON lines, another name",
            json("{\"pose\":2", "{\"Pose\":2"),
            Refused("line 2: Pose is not in the first object", "same names"),
        ),
        input(
            "JSON lines, a list in a cell",
            json("2.75", "[2.75]"),
            Refused("line 2: db_um is no number", ""),
        ),
        input("JSON lines, null", json("2.75", "null"), Refused("line 2 (db_um): the cell is empty", "")),
        input("JSON lines without a unit", json("fz_N", "fz"), Refused("fz: the name has no unit", "fz_N")),
    ]
}
