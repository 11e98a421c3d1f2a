//! Tables of ball centers as people make them; the layouts of measuring programs are tested beside their readers.

use super::{Cell, Input, Read, Refused, cells, german, input, ods, utf16, windows_1252, xlsx};

pub(crate) const PLAIN: &str = "record,ball,x_mm,y_mm,z_mm\nR1,P1,120.125,0.5,-1250.25\nR1,P2,-60.5,103.25,-1250\n\
    R2,P1,121.125,0.25,-1251.5\nR2,P2,-59.5,103.5,-1251.75\n";
const WIDE: &str = "record,P1_x_mm,P1_y_mm,P1_z_mm,P2_x_mm,P2_y_mm,P2_z_mm\nR1,120.125,0.5,-1250.25,-60.5,103.25,-1250\n\
    R2,121.125,0.25,-1251.5,-59.5,103.5,-1251.75\n";

fn with(from: &str, to: &str) -> String {
    assert!(PLAIN.contains(from), "{from}");
    PLAIN.replace(from, to)
}

pub(crate) fn inputs() -> Vec<Input> {
    let german = german(PLAIN);
    let below = |row: &str| format!("{PLAIN}{row}\n");
    let list = PLAIN.split_once('\n').unwrap().1;
    vec![
        input("the plain table", PLAIN, Read("")),
        input("German Excel", german.as_str(), Read("decimal comma")),
        input(
            "the same in Windows-1252 with sep=;",
            windows_1252(&format!("sep=;\r\n{}", german.replace("x_mm", "x [mm]"))),
            Read("decimal comma"),
        ),
        input("Unicode text of Excel", utf16(&PLAIN.replace(',', "\t"), false), Read("UTF-16LE")),
        input("units in a second row", PLAIN.replacen('\n', "\n-,-,mm,mm,mm\n", 1), Read("")),
        input("empty columns and rows at the end", PLAIN.replace('\n', ",,\n") + ",,,,,,\n", Read("")),
        input("all balls of a record in one row", WIDE, Read("")),
        input(
            "the same with units in brackets",
            WIDE.replace("_x_mm", " X [mm]").replace("_y_mm", " Y [mm]").replace("_z_mm", " Z [mm]"),
            Read(""),
        ),
        input(
            "two exports one below the other",
            PLAIN.replace("\nR2,P1", "\nrecord,ball,x_mm,y_mm,z_mm\nR2,P1"),
            Read("come again"),
        ),
        input("xlsx", xlsx(&[("Balls", cells(PLAIN))]), Read("")),
        input("ods, all balls of a record in one row", ods(&[("balls", cells(WIDE))]), Read("")),
        input(
            "further columns",
            with("z_mm", "z_mm,diameter")
                .replace("50\n", "50,20\n")
                .replace("25\n", "25,20\n")
                .replace(".5\n", ".5,20\n")
                .replace("75\n", "75,20\n"),
            Read(""),
        ),
        input("no unit", with("x_mm", "x"), Refused("has no unit", "x_mm")),
        input(
            "a list without names of columns",
            list,
            Refused("states no unit for its coordinates", "--unit mm"),
        ),
        input(
            "names of columns of another program",
            with("record,ball", "Messung,Element"),
            Refused("missing: record, ball", "--columns"),
        ),
        input(
            "thousands without decimals among decimal commas",
            german.replace("-1250;", "-1.250;").replace("-1250\n", "-1.250\n"),
            Refused("are mixed", ""),
        ),
        input(
            "a row of means",
            below("Mean,P1,120.6,0.4,-1250.9").replace("120.6", "n/a"),
            Refused("a sum, a mean or the like", ""),
        ),
        input(
            "a ball twice in a record",
            with("R2,P2", "R2,P1"),
            Refused("ball P1 is twice in record R2", "separate records"),
        ),
        input(
            "xlsx, a word in place of a number",
            xlsx(&[("balls", with_word())]),
            Refused("row 3, column 4 (y_mm): \"lost\"", ""),
        ),
        input(
            "a cell without a number in a wide table",
            WIDE.replacen("103.25", "", 1),
            Refused("the cell is empty", ""),
        ),
    ]
}

fn with_word() -> Vec<Vec<Cell>> {
    let mut rows = cells(PLAIN);
    rows[2][3] = Cell::Text("lost".into());
    rows
}
