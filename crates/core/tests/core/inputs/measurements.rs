//! Tables of measurements as people make them.

use super::workbook_tables::{json_lines, workbooks};
use super::{Input, Read, Refused, german, input, utf16, windows_1252};

const HEADER: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
    da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
const ROWS: [&str; 2] = [
    "1,1,6.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,-1.5,2.25,-13.125,-18.5,18.375,61.75",
    "2,1,7.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,-0.5,2.75,-13.25,-12.125,20.75,61.25",
];
/// Newtons in a pound-force.
const LBF: f64 = 4.448_221_615_260_5;

pub(crate) fn plain() -> String {
    format!("{HEADER}\n{}\n{}\n", ROWS[0], ROWS[1])
}

/// The plain file with another text in every such place.
fn with(from: &str, to: &str) -> String {
    assert!(plain().contains(from), "{from}");
    plain().replace(from, to)
}

/// The plain file with a line of its own below the names of the columns.
fn below_the_names(line: &str) -> String {
    plain().replacen('\n', &format!("\n{line}\n"), 1)
}

/// The force of the plain file in another unit.
fn force_in(unit: &str, newtons: f64) -> String {
    with("fz_N", &format!("fz [{unit}]")).replace("-338.5", &(-338.5 / newtons).to_string())
}

pub(crate) fn inputs() -> Vec<Input> {
    [text_read(), units_read(), workbooks(&plain()), names_refused(), cells_refused(), files_refused()]
        .into_iter()
        .flatten()
        .collect()
}

/// Ways of writing the same text.
fn text_read() -> Vec<Input> {
    let quoted = format!("\"{}\"\n", plain().trim_end().replace(',', "\",\"").replace('\n', "\"\n\""));
    let german = german(&plain());
    let in_windows = german.replace("da_um", "da [µm]").replace("alpha_deg", "alpha [°]");
    let twice = plain() + &plain();
    vec![
        input("the plain table", plain(), Read("")),
        input("line ends of Windows", plain().replace('\n', "\r\n"), Read("")),
        input("CSV UTF-8 of Excel, with a byte order mark", format!("\u{feff}{}", plain()), Read("")),
        input("German Excel: semicolons and decimal commas", german.as_str(), Read("decimal comma")),
        input("the same with sep=; in the first line", format!("sep=;\r\n{german}"), Read("decimal comma")),
        input("German Excel in Windows-1252, with µm and °", windows_1252(&in_windows), Read("windows-1252")),
        input("cells copied to a text editor: tabs", plain().replace(',', "\t"), Read("tabs")),
        input(
            "Unicode text of Excel: UTF-16 and tabs",
            utf16(&plain().replace(',', "\t"), false),
            Read("UTF-16LE"),
        ),
        input("UTF-16, the other way round", utf16(&plain(), true), Read("UTF-16BE")),
        input("every cell in quotation marks", quoted.as_str(), Read("")),
        input(
            "the same with decimal commas and semicolons",
            quoted.replace("\",\"", "\";\"").replace('.', ","),
            Read("decimal comma"),
        ),
        input("blanks around the cells", plain().replace(',', " , "), Read("")),
        input(
            "columns in another order",
            with("pose,repeat,a_mm", "repeat,pose,a_mm").replace("\n2,1,", "\n1,2,"),
            Read(""),
        ),
        input("a capital in a name", with("fz_N", "FZ_N"), Read("")),
        input("empty columns at the end", plain().replace('\n', ",,\n"), Read("")),
        input("rows of empty cells at the end", format!("{}{}\n", plain(), ",".repeat(19)), Read("")),
        input("a row of empty cells above the names", format!("{}\n{}", ",".repeat(19), plain()), Read("")),
        input("a comment above the names", format!("# bench 3\n{}", plain()), Read("")),
        input("a commented row", format!("{}#3{}\n", plain(), &ROWS[1][1..]), Read("")),
        input(
            "a column of notes",
            with("dgamma_urad", "dgamma_urad,note").replace("61.75", "61.75,warm").replace("61.25", "61.25,"),
            Read(""),
        ),
        input(
            "a column of another quantity",
            with("dgamma_urad", "dgamma_urad,humidity_%")
                .replace("61.75", "61.75,40")
                .replace("61.25", "61.25,41"),
            Read("unknown column, ignored"),
        ),
        input("no line end after the last row", plain().trim_end(), Read("does not end with a newline")),
        input("the minus of typesetting", with(",-", ",\u{2212}"), Read("")),
        input("a dash in place of the minus, as word processors make it", with(",-", ",\u{2013}"), Read("")),
        input("a table pasted below itself", twice.as_str(), Read("come again")),
        input(
            "two exports one below the other, each with its names",
            format!("{HEADER}\n{}\n{HEADER}\n{}\n", ROWS[0], ROWS[1]),
            Read("come again (line 3)"),
        ),
        input("JSON lines", json_lines(&plain()), Read("")),
        input("JSON lines with a blank line", json_lines(&plain()).replace("}\n", "}\n\n"), Read("")),
    ]
}

/// Ways of stating units.
fn units_read() -> Vec<Input> {
    let units = "-,-,mm,mm,mm,deg,deg,deg,N,N,N,N·m,N·m,N·m,um,um,um,urad,urad,urad";
    vec![
        input(
            "units in brackets: fz [N], a (mm)",
            with("fz_N", "fz [N]").replace("a_mm", "a (mm)"),
            Read(""),
        ),
        input(
            "quantity / unit, as ISO 80000 heads tables",
            with("fz_N", "fz / N").replace("da_um", "da / µm"),
            Read(""),
        ),
        input("da in um", with("da_um", "da in um"), Read("")),
        input(
            "µm with both code points there are",
            with("da_um", "da_\u{b5}m").replace("db_um", "db_\u{3bc}m"),
            Read(""),
        ),
        input("units in a second row", below_the_names(units), Read("")),
        input(
            "units in brackets in a second row",
            below_the_names(
                &units
                    .replace(',', "],[")
                    .replacen('-', "[", 1)
                    .replace("um],[urad],[urad],[urad", "um],[urad],[urad],[urad]"),
            ),
            Read(""),
        ),
        input("kilonewtons", force_in("kN", 1e3), Read("")),
        input("dekanewtons", force_in("daN", 10.0), Read("")),
        input("kilogram-force", force_in("kgf", 9.806_65), Read("")),
        input("pound-force", force_in("lbf", LBF), Read("")),
        input("moments in lbf·in", with("mx_Nm", "mx [lbf·in]"), Read("")),
        input("arcseconds", with("alpha_deg", "alpha_arcsec").replace("-7.5,0.75", "-27000,0.75"), Read("")),
        input(
            "arcseconds as ″",
            with("alpha_deg", "alpha [″]").replace("-7.5,0.75", "-27000,0.75"),
            Read(""),
        ),
        input("degrees as º, which is no degree sign", with("alpha_deg", "alpha [º]"), Read("")),
        input(
            "inches",
            with("a_mm", "a_inch")
                .replace("6.5,4", &format!("{},4", 6.5 / 25.4))
                .replace("7.5,4", &format!("{},4", 7.5 / 25.4)),
            Read(""),
        ),
    ]
}

/// Lines above the rows that name no columns, or others.
fn names_refused() -> Vec<Input> {
    let renamed = |names: &str| with("fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm", names);
    let others = "X_mm,Y_mm,Z_mm,Rx_deg,Ry_deg,Rz_deg";
    let groups = "No.,,Pose,,,,,,Load,,,,,,Reading,,,,,";
    vec![
        input("no names of columns", ROWS.join("\n"), Refused("must name the columns", "Add a first line")),
        input(
            "a title above the names",
            format!("Bench 3\n{}", plain()),
            Refused("they seem to be in line 2", "Remove what stands above line 2"),
        ),
        input(
            "merged cells above the names",
            format!("{groups}\n{}", plain()),
            Refused("names groups of columns", "begin it with #"),
        ),
        input("no unit", with("fz_N", "fz"), Refused("has no unit", "fz_N")),
        input("a unit of another kind", with("fz_N", "fz_mm"), Refused("mm is a unit of length", "fz_N")),
        input(
            "Grad, degrees in German and 0.9 degrees in English",
            with("alpha_deg", "alpha [Grad]"),
            Refused("\"Grad\" is not a known unit", "deg"),
        ),
        input(
            "a unit whose capitals matter",
            with("fz_N", "fz_mn"),
            Refused("\"mn\" is not a known unit", "MN"),
        ),
        input(
            "another unit in the second row",
            below_the_names(",,mm,mm,mm,deg,deg,deg,N,N,kN,Nm,Nm,Nm,um,um,um,urad,urad,urad"),
            Refused("contradicts", ""),
        ),
        input(
            "names of a controller",
            with("a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg", others),
            Refused("missing: a_mm", "--columns: X_mm is a_mm"),
        ),
        input(
            "German names",
            renamed("Kraft x [N],Kraft y [N],Kraft z [N],Moment x [Nm],Moment y [Nm],Moment z [Nm]"),
            Refused("missing: fx_N", "Kraft x [N] is fx_N"),
        ),
        input(
            "French names",
            renamed("Force_x_N,Force_y_N,Force_z_N,Couple_x_Nm,Couple_y_Nm,Couple_z_Nm"),
            Refused("missing: fx_N", "Couple_x_Nm is mx_Nm"),
        ),
        input(
            "Spanish names",
            renamed("Fuerza x (N),Fuerza y (N),Fuerza z (N),Momento x (Nm),Momento y (Nm),Momento z (Nm)"),
            Refused("missing: fx_N", "Fuerza x (N) is fx_N"),
        ),
        input(
            "a slip of the pen",
            with("dalpha_urad", "dapha_urad"),
            Refused("probably \"dalpha_urad\"", "Write dalpha_urad"),
        ),
        input("a column twice", with("my_Nm", "mx_Nm"), Refused("mx is given twice", "Keep this column")),
        input(
            "the index that pandas writes in front",
            plain().replace("\n1,", "\n0,1,").replace("\n2,", "\n1,2,").replacen("pose", ",pose", 1),
            Refused("the column has no name", "or remove it"),
        ),
        input(
            "a line break inside a name",
            with("da_um", "\"da\n[um]\""),
            Refused("quotation mark is not closed", "one line"),
        ),
        input(
            "other units in names that come again",
            format!("{}{}\n{}\n", plain(), HEADER.replace("da_um", "da_mm"), ROWS[0]),
            Refused("named again here, otherwise", "a file of its own"),
        ),
    ]
}

/// Cells and rows that are no readings.
fn cells_refused() -> Vec<Input> {
    let in_cell = |text: &str| with("2.75", text);
    let row_below = |row: &str| format!("{}{row}\n", plain());
    let german = german(&plain());
    vec![
        input(
            "a number that a spreadsheet made a date",
            in_cell("3.Mai"),
            Refused("this is a date", "as text"),
        ),
        input("a time of day", in_cell("00:05:30"), Refused("a time of day", "number in the unit")),
        input(
            "thousands separators, German",
            german.replace("-338,5", "-1.338,5"),
            Refused("thousands separators", ""),
        ),
        input("thousands separators, English", in_cell("\"2,750.5\""), Refused("thousands separators", "")),
        input("thousands separators, Swiss", in_cell("2'750.5"), Refused("thousands separators", "")),
        input(
            "thousands without decimals among decimal commas",
            german.replace("-338,5", "-1.338"),
            Refused("are mixed", "without thousands"),
        ),
        input(
            "a decimal comma in a table with commas",
            in_cell("\"2,75\""),
            Refused("needs a decimal point", "semicolons"),
        ),
        input(
            "a decimal comma that splits a cell",
            in_cell("2,75"),
            Refused("the row has 21 cells", "decimal comma"),
        ),
        input("n/a", in_cell("n/a"), Refused("is not a value", "Omit the row")),
        input("a dash for nothing", in_cell("-"), Refused("is not a value", "Omit the row")),
        input("NaN", in_cell("NaN"), Refused("NaN and infinity", "")),
        input("1.#QNAN, as older C programs write it", in_cell("1.#QNAN"), Refused("is not a value", "")),
        input("#WERT!, an error of German Excel", in_cell("#WERT!"), Refused("is not a value", "")),
        input(
            "#N/A in the first cell, which is no comment",
            row_below(&format!("#N/A{}", &ROWS[1][1..])),
            Refused("\"#N/A\": this is not a value", ""),
        ),
        input("######, of a narrow column", in_cell("######"), Refused("too narrow", "wider")),
        input(
            "###### in the first cell, which is no comment",
            row_below(&format!("######{}", &ROWS[1][1..])),
            Refused("too narrow", "wider"),
        ),
        input("a formula in place of its value", in_cell("=B2*1000"), Refused("a formula", "values")),
        input(
            "a number with its unit",
            in_cell("2.75 um"),
            Refused("not a number", "units belong in the column name"),
        ),
        input("minus in brackets, as accountants write it", in_cell("(2.75)"), Refused("not a number", "")),
        input("minus behind the number", in_cell("2.75-"), Refused("not a number", "")),
        input("degrees, minutes and seconds", with("-7.5", "-7°30'"), Refused("not a number", "")),
        input("an empty cell", in_cell(""), Refused("the cell is empty", "")),
        input(
            "a row of means at the end",
            row_below(&format!("Mean:{}", &ROWS[1][1..])),
            Refused("a sum, a mean or the like", "Remove the line"),
        ),
        input(
            "a row of sums in German",
            row_below(&format!("Summe{},", ",".repeat(18))),
            Refused("a sum, a mean or the like", ""),
        ),
        input(
            "a comment that begins with %",
            row_below("% the end"),
            Refused("seems to be a comment", "with #"),
        ),
        input(
            "a comment that begins with //",
            row_below("// repeated on Monday"),
            Refused("seems to be a comment", "with #"),
        ),
        input(
            "names in the column of pose numbers",
            plain().replace("\n2,", "\nP2,"),
            Refused("whole number", "note_pose"),
        ),
        input(
            "degrees in a column of radians",
            with("alpha_deg", "alpha_rad"),
            Refused("1.194 turns", "Check the unit"),
        ),
    ]
}

/// Files that are no table.
fn files_refused() -> Vec<Input> {
    vec![
        input(
            "a file that was cut",
            &plain()[..plain().len() - 30],
            Refused("the file is truncated", "again"),
        ),
        input(
            "line ends of the old Macintosh",
            plain().replace('\n', "\r"),
            Refused("bare carriage return", ""),
        ),
        input("columns held apart by blanks alone", plain().replace(',', "  "), Refused("no separator", "")),
        input(
            "a web page, also one called .xls",
            "<!DOCTYPE html>\n<html><table></table></html>\n",
            Refused("a web page or XML", ".xlsx"),
        ),
        input("a PDF", "%PDF-1.7\n%\u{e2}\n", Refused("this is a PDF", "Export the table")),
        input(
            "a list of JSON",
            format!("[{}]\n", json_lines(&plain()).trim_end().replace('\n', ",")),
            Refused("one list of JSON", "lines=True"),
        ),
        input("one JSON object", "{\n \"pose\": [1, 2]\n}\n", Refused("no JSON object", "one object a line")),
        input("nothing", Vec::new(), Refused("empty", "Export")),
    ]
}
